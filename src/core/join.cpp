#include "core/join.h"

namespace lightwell {
namespace {

template <class Text>
std::string join_texts(std::span<const Text> parts) {
  std::string joined;
  for (const Text& part : parts) joined.append(joined.empty() ? "" : ", ").append(part);
  return joined;
}

}  // namespace

std::string join(std::span<const std::string> parts) {
  return join_texts(parts);
}

std::string join(std::span<const std::string_view> parts) {
  return join_texts(parts);
}

}  // namespace lightwell
