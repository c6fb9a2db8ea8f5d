// What an importer mended, left out or cannot show: one warning a kind of thing and file.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lightwell {

class FileNotes {
 public:
  // `subject` names the file.
  explicit FileNotes(std::string subject) : subject_(std::move(subject)) {}

  // `place`: where it is, such as "nodes[3].rotation" or "line 7"; `what`: what is wrong and what was done about it,
  // which tells kinds apart. After many kinds the rest are one.
  void add(std::string_view place, std::string_view what, std::size_t count = 1) {
    add([place] { return std::string(place); }, what, count);
  }
  // The same where the place takes time to write down: `place()` is called for the first of a kind only.
  template <std::invocable Place>
  void add(Place place, std::string_view what, std::size_t count = 1) {
    Note& note = find(what);
    if (note.count == 0) note.place = place();
    note.count += count;
  }

  // Logs a warning a kind, in the order in which they came: "room.gltf: nodes[3].rotation: is zero ... (7 times)".
  void log();

 private:
  struct Note {
    std::string what;
    std::string place;
    std::size_t count = 0;
  };
  Note& find(std::string_view what);

  std::string subject_;
  std::vector<Note> notes_;
};

}  // namespace lightwell
