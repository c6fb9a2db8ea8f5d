#include "passes/light_cache/link_pages.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "core/log.h"
#include "graph/linear_dispatch.h"
#include "kernels/passes/light_cache/cache_pages.comp.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kWord = sizeof(std::uint32_t);
// A moment of want, as where a camera jumps, is none.
constexpr std::uint32_t kFramesUntilWarning = 16;
constexpr std::string_view kName = "light cache: pages";

BufferHandle find_side(FrameGraph& graph, const char* name, std::uint32_t side, std::uint64_t count,
                       std::uint32_t stride, bool& fresh) {
  bool is_fresh = false;
  const BufferHandle buffer = graph.history_buffer(name + std::string(side == 0 ? "" : " 2"), count, stride, is_fresh);
  fresh = fresh || is_fresh;
  return buffer;
}

struct Side {
  BufferHandle links;
  BufferHandle free;
};

Side find_side(FrameGraph& graph, std::uint32_t side, std::uint32_t pages, std::uint32_t links, bool& fresh) {
  return {find_side(graph, "face links", side, std::uint64_t{pages} * links, sizeof(glsl::FaceLink), fresh),
          find_side(graph, "free link pages", side, pages, kWord, fresh)};
}

void list_pages(FrameGraph& graph, LinkPages& pages, const glsl::CacheParams& params, BufferHandle owned) {
  dispatch_linear(graph.compute(kName, kernels::light_cache_cache_pages_comp)
                      .read("owned", owned)
                      .write("page_counts", pages.counts)
                      .write("free_pages", pages.free)
                      .push(params),
                  pages.count - params.count);
}

}  // namespace

std::uint32_t count_pages(std::uint64_t bytes, std::uint32_t links) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 27;
  return static_cast<std::uint32_t>(
      std::max<std::uint64_t>(std::min(bytes, kMostBytes) / (sizeof(glsl::FaceLink) * links), 1));
}

LinkPages LinkPagePool::find(FrameGraph& graph, const LinkPageSettings& settings) {
  const bool known = count_ > 0 && links_ == settings.links;
  const bool short_of = known && need_->missing > 0 && need_->count == count_;
  LinkPages pages;
  pages.count = std::min(known ? (short_of ? 2 * count_ : count_) : settings.first, settings.most);
  const bool grows = known && pages.count > count_;
  const std::uint32_t side = grows ? 1 - side_ : side_;
  bool fresh = false;
  pages.counts = graph.history_buffer("link page counts", glsl::kPageCountWords, kWord, fresh);
  bool side_fresh = false;
  const Side now = find_side(graph, side, pages.count, settings.links, side_fresh);
  pages.links = now.links;
  pages.free = now.free;
  pages.first_new = pages.count;
  if (!grows) fresh = fresh || side_fresh;
  if (grows) {
    const Side before = find_side(graph, side_, count_, links_, fresh);
    const std::uint64_t links = std::uint64_t{count_} * links_;
    graph.copy(kName, before.links, pages.links, links * sizeof(glsl::FaceLink));
    graph.copy(kName, before.free, pages.free, std::uint64_t{count_} * kWord);
    pages.first_new = count_;
  }
  pages.fresh = fresh;
  graph.on_recorded([this, side, links = settings.links, count = pages.count] {
    side_ = side;
    links_ = links;
    count_ = count;
  });
  return pages;
}

void LinkPagePool::watch(FrameGraph& graph, const LinkPages& pages, const LinkPageSettings& settings) const {
  const bool is_last = pages.count >= settings.most;
  graph.watch(pages.counts, [need = need_, count = pages.count, is_last](std::span<const std::byte> bytes) {
    std::array<std::uint32_t, glsl::kPageCountWords> words{};
    std::memcpy(words.data(), bytes.data(), sizeof words);
    need->count = count;
    need->used = count - words[glsl::kPagesFree];
    need->missing = words[glsl::kPagesShort];
    need->short_frames = need->missing > 0 ? need->short_frames + 1 : 0;
    if (need->warned || !is_last || need->short_frames < kFramesUntilWarning) return;
    need->warned = true;
    log_warning("light cache: there is room for the links of " + std::to_string(count) + " faces, and " +
                std::to_string(need->missing) + " more gather no light");
  });
}

void record_free_pages(FrameGraph& graph, LinkPages& pages, glsl::CacheParams params, BufferHandle owned) {
  const std::array<std::uint32_t, 1> none{0};
  const BufferHandle zero = graph.upload("no pages", std::span<const std::uint32_t>(none));
  graph.copy(kName, zero, pages.counts, kWord, 0, glsl::kPagesFree * kWord);
  params.count = 0;
  list_pages(graph, pages, params, owned);
}

void record_new_pages(FrameGraph& graph, LinkPages& pages, glsl::CacheParams params) {
  if (pages.first_new >= pages.count) return;
  BufferHandle owned = graph.create_buffer("owned link pages", pages.count, kWord);
  graph.fill(kName, owned, 0);
  params.count = pages.first_new;
  list_pages(graph, pages, params, owned);
}

}  // namespace lightwell
