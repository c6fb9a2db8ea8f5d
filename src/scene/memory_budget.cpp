#include "scene/memory_budget.h"

#include <algorithm>

#include "lightwell/error.h"

namespace lightwell {

std::uint64_t MemoryBudget::allowed() const {
  return std::min(limit_.base + limit_.per_input_byte * input_, limit_.most);
}

void MemoryBudget::charge(std::uint64_t count, std::uint64_t bytes_each) {
  if (bytes_each == 0) return;
  if (count > (allowed() - used_) / bytes_each)
    throw InputError(subject_, "more than " + std::to_string(allowed() >> 20) + " MiB of " + content_ +
                                   (allowed() == limit_.most ? "" : ", far more data than the file holds"));
  used_ += count * bytes_each;
}

}  // namespace lightwell
