// References from one scene file to another.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

// Bytes of a "data:" URI with base64 content; nothing if `uri` is another kind of URI. Throws InputError naming
// `subject` if the content is not base64.
std::optional<std::vector<std::uint8_t>> decode_data_uri(const std::string& subject, std::string_view uri);

// Path of the file that a relative URI (percent-encoded) means, seen from the file `base`. Throws InputError naming
// `base` for other schemes.
std::string resolve_uri(const std::string& base, const std::string& uri);

// Path of a file named without encoding (MTL; either slash), seen from the file `base`. Throws InputError naming `base`
// if the name holds a zero byte.
std::string resolve_name(const std::string& base, std::string name);

// What an image's URI says without its encoding, and without "file://".
std::string image_name(const std::string& uri);

// Behind the last slash of either kind; of an address of the web, without its query.
std::string last_part(std::string name);

}  // namespace lightwell
