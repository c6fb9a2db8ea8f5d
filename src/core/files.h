// Whole-file input and all-or-nothing output.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace lightwell {

// Reads a regular file. Throws InputError (missing, a folder, unreadable, larger than max_bytes).
std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes = std::uint64_t{1} << 32);

// Calls `write` with a temporary name beside `path`, then renames it to `path`: readers see the old file or the whole
// new one. `write` throws to give up; the temporary is removed then. Throws InputError naming `path`.
void write_file_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write);

// The same for bytes that are already there.
void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes);

// Throws InputError now if `path` could not be written later (folder missing, read-only), so that an hour of rendering
// is not lost at its end.
void check_writable(const std::string& path);

}  // namespace lightwell
