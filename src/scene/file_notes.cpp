#include "scene/file_notes.h"

#include <algorithm>

#include "core/log.h"

namespace lightwell {

namespace {

constexpr std::size_t kMostKinds = 64;

}  // namespace

FileNotes::Note& FileNotes::find(std::string_view what) {
  const auto found = std::find_if(notes_.begin(), notes_.end(), [&](const Note& note) { return note.what == what; });
  if (found != notes_.end()) return *found;
  if (notes_.size() > kMostKinds) return notes_.back();
  const bool is_last = notes_.size() == kMostKinds;
  return notes_.emplace_back(Note{is_last ? "and more that is not as it should be" : std::string(what), "", 0});
}

void FileNotes::log() {
  for (const Note& note : notes_) {
    const std::string times = note.count > 1 ? " (" + std::to_string(note.count) + " times)" : "";
    log_warning(subject_ + ": " + (note.place.empty() ? "" : note.place + ": ") + note.what + times);
  }
  notes_.clear();
}

}  // namespace lightwell
