#include "scene/complaints.h"

#include "core/log.h"

namespace lightwell {

void Complaints::add(const std::string& place, const std::string& what) {
  constexpr std::size_t kMostKinds = 50;  // of statements that nobody knows there may be a million
  const auto found = indices_.find(what);
  if (found != indices_.end()) {
    ++kinds_[found->second].count;
    return;
  }
  if (kinds_.size() >= kMostKinds) return;
  const std::string last = kinds_.size() + 1 < kMostKinds ? what : "and more that is left out";
  indices_[what] = kinds_.size();
  kinds_.push_back({last, place, 1});
}

void Complaints::log() const {
  for (const Kind& kind : kinds_) {
    const std::string more = kind.count > 1 ? " (and " + std::to_string(kind.count - 1) + " more)" : "";
    log_warning(subject_ + ": " + kind.first_place + more + ": " + kind.what);
  }
}

}  // namespace lightwell
