// What an importer left out or changed: one warning for each kind of thing, however often it happened.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lightwell {

class Complaints {
 public:
  // `subject` names the file.
  explicit Complaints(std::string subject) : subject_(std::move(subject)) {}

  // `what`: what is wrong and what was done about it. `place`: where, "line 7".
  void add(const std::string& place, const std::string& what);

  // Logs "subject: line 7 (and 3 more): what" for each kind, in the order in which they came up.
  void log() const;

 private:
  struct Kind {
    std::string what;
    std::string first_place;
    std::size_t count = 0;
  };

  std::string subject_;
  std::vector<Kind> kinds_;
  std::map<std::string, std::size_t> indices_;  // into kinds_, by `what`
};

}  // namespace lightwell
