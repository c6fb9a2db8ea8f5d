// Keeps small files from asking for huge memory: what a file unfolds into is bounded by a multiple of its size.
#pragma once

#include <cstdint>
#include <string>

namespace lightwell {

// Geometry may be repeated (accessors shared by many primitives, accessors without data, strips, flat shading), so the
// limit is generous: 64 MiB and 64 bytes for each byte read.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::string subject) : subject_(std::move(subject)) {}

  void add_input(std::uint64_t bytes) { limit_ += 64 * bytes; }

  // Throws InputError if `count` elements of `bytes_each` more do not fit. Both below 2^53.
  void charge(std::uint64_t count, std::uint64_t bytes_each);

 private:
  std::string subject_;
  std::uint64_t limit_ = std::uint64_t{64} << 20;
  std::uint64_t used_ = 0;
};

}  // namespace lightwell
