#include "scene/memory_budget.h"

#include "lightwell/error.h"

namespace lightwell {

void MemoryBudget::charge(std::uint64_t count, std::uint64_t bytes_each) {
  if (bytes_each == 0) return;
  if (count > (limit_ - used_) / bytes_each)
    throw InputError(subject_, "unfolds into far more data than the file holds (more than " +
                                   std::to_string(limit_ >> 20) + " MiB)");
  used_ += count * bytes_each;
}

}  // namespace lightwell
