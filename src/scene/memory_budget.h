// Keeps small files from asking for huge memory: what a file unfolds into is bounded by a multiple of its size.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace lightwell {

// In bytes: `base`, and so many for each byte read, but never more than `most`.
struct MemoryLimit {
  std::uint64_t base;
  std::uint64_t per_input_byte;
  std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
};

// Geometry may be repeated (accessors shared by many primitives, accessors without data, strips, flat shading), so its
// limit is generous.
inline constexpr MemoryLimit kGeometryLimit = {.base = std::uint64_t{64} << 20, .per_input_byte = 64};

class MemoryBudget {
 public:
  // `subject` and `content` say in errors whose memory it is: a file and "textures".
  MemoryBudget(std::string subject, std::string content, const MemoryLimit& limit)
      : subject_(std::move(subject)), content_(std::move(content)), limit_(limit) {}

  void add_input(std::uint64_t bytes) { input_ += bytes; }

  // Throws InputError if `count` elements of `bytes_each` more do not fit. Both below 2^53.
  void charge(std::uint64_t count, std::uint64_t bytes_each);

 private:
  std::uint64_t allowed() const;

  std::string subject_;
  std::string content_;
  MemoryLimit limit_;
  std::uint64_t input_ = 0;
  std::uint64_t used_ = 0;
};

}  // namespace lightwell
