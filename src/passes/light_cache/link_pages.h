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
  BufferHandle links;           // uvec2 a link
  BufferHandle free;            // uint a page: the list of free ones
  BufferHandle counts;          // uint, words as in cache_types.h
  std::uint32_t first_new = 0;  // pages from this one on are not in the list yet
  bool fresh = false;           // no face has a page
};

// Finds a scope's pages in every frame. There are twice as many where faces found none; what pages hold stays.
class LinkPagePool {
 public:
  LinkPages find(FrameGraph& graph, const LinkPageSettings& settings);
  // After the frame's last round: looks whether there were enough.
  void watch(FrameGraph& graph, const LinkPages& pages) const;

 private:
  struct Need {
    std::uint32_t count = 0;  // pages that there were
    std::uint32_t missing = 0;
  };
  std::shared_ptr<Need> need_ = std::make_shared<Need>();  // in the last frame that is known to be complete
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
