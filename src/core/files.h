// Whole-file input and all-or-nothing output.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace lightwell {

// Reads a regular file. Throws InputError (missing, a folder, unreadable, larger than max_bytes).
std::vector<std::uint8_t> read_file(const std::string& path, std::uint64_t max_bytes = std::uint64_t{1} << 32);

// Writes beside the file and renames then: readers see the old file or the whole new one. As with other programs a
// symbolic link is followed, and a file that is overwritten keeps its mode. Throws InputError naming `path`.
void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes);

// Removes what write_file_atomically() has begun in any thread: for handlers of signals that end the program. May be
// called at any moment.
void discard_partial_files() noexcept;

// Throws InputError now if `path` could not be written later (folder missing, read-only), so that an hour of rendering
// is not lost at its end.
void check_writable(const std::string& path);

}  // namespace lightwell
