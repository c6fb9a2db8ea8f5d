// The memory of faces' links: pages of one size, which faces take and give back on the device (cache_types.h).
#pragma once

#include <cstdint>
#include <memory>

#include "graph/frame_graph.h"
#include "passes/light_cache/cache_types.h"

namespace lightwell {

struct LinkPageSettings {
  std::uint32_t links = 128;  // a page
  std::uint32_t first = 1;    // pages that there are at first
  std::uint32_t most = 1;     // pages that there may be
};

// Pages that fit into so many bytes, and into the range that every device can bind (128 MiB).
std::uint32_t count_pages(std::uint64_t bytes, std::uint32_t links);

// This frame's.
struct LinkPages {
  std::uint32_t count = 0;
  BufferHandle links;           // glsl::FaceLink a link
  BufferHandle free;            // uint a page: the list of free ones
  BufferHandle counts;          // uint, words as in cache_types.h
  std::uint32_t first_new = 0;  // pages from this one on are not in the list yet
  bool fresh = false;           // no face has a page
};

// In the last frame that is known to be complete.
struct LinkNeed {
  std::uint32_t count = 0;         // pages that there were
  std::uint32_t used = 0;          // of them, those that faces had
  std::uint32_t missing = 0;       // pages that awake faces asked for in vain
  std::uint32_t short_frames = 0;  // in a row
  bool warned = false;
};

// Finds a scope's pages in every frame. There are twice as many where faces found none; what pages hold stays. Where
// there may be no more, a warning is logged, once.
class LinkPagePool {
 public:
  LinkPages find(FrameGraph& graph, const LinkPageSettings& settings);
  // After the world's part of the frame: looks whether there were enough.
  void watch(FrameGraph& graph, const LinkPages& pages, const LinkPageSettings& settings) const;
  const LinkNeed& need() const { return *need_; }

 private:
  std::shared_ptr<LinkNeed> need_ = std::make_shared<LinkNeed>();
  // Of last frame.
  std::uint32_t side_ = 0;  // of two histories that take turns in growing
  std::uint32_t links_ = 0;
  std::uint32_t count_ = 0;
};

// Lists the pages that are free anew: those that `owned` (uint a page, not 0: a face has it) does not name.
void record_free_pages(FrameGraph& graph, LinkPages& pages, glsl::CacheParams params, BufferHandle owned);
// Adds those to the list that are new in this frame, if any are.
void record_new_pages(FrameGraph& graph, LinkPages& pages, glsl::CacheParams params);

}  // namespace lightwell
