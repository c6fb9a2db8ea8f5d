// What outlives a frame on the declaring side: GraphContext, and FrameGraph's histories.
#include "graph/history.h"

#include <algorithm>
#include <utility>

#include "graph/frame_graph.h"
#include "lightwell/error.h"

namespace lightwell {

const Reflection& GraphContext::reflection(const KernelCode& code) {
  auto [it, added] = reflections_.try_emplace(code.spirv.data());
  if (added) it->second = reflect(code);
  return it->second;
}

void GraphContext::forget_histories() {
  history_buffers.clear();
  history_images.clear();
}

namespace {

// Of a pair whose two resources are `first` and the next one in the graph, `previous` before `current`.
HistoryKey make_pair_key(const std::string& name, std::uint32_t last_side, std::uint32_t first, bool current) {
  return {.name = name,
          .is_pair = true,
          .side = current ? 1 - last_side : last_side,
          .partner = current ? first : first + 1,
          .is_current = current};
}

// The state of a history with this description, or null where there is none.
template <class Desc>
const HistoryState<Desc>* find_history(const std::map<std::string, HistoryState<Desc>>& histories,
                                       const std::string& name, const Desc& desc) {
  const auto it = histories.find(name);
  return it != histories.end() && it->second.desc == desc ? &it->second : nullptr;
}

template <class Resource>
void check_new_history(const std::vector<Resource>& resources, const std::string& name) {
  for (const Resource& resource : resources)
    LW_ASSERT(resource.history.name != name, name + ": this history is asked for twice");
}

template <class Resource, class Desc>
void note_histories(const std::vector<Resource>& resources, const std::vector<bool>& written,
                    std::map<std::string, HistoryState<Desc>>& histories, std::uint64_t frame) {
  for (std::size_t i = 0; i < resources.size(); ++i) {
    const HistoryKey& key = resources[i].history;
    if (key.name.empty()) continue;
    HistoryState<Desc>& state = histories[key.name];
    if (!(state.desc == resources[i].desc)) state = {resources[i].desc};
    if (!key.is_current || !written[i]) continue;
    state.written = frame;
    state.last_side = key.side;
  }
}

}  // namespace

FrameGraph::~FrameGraph() {
  if (!recorded_ && !passes_.empty()) context_.forget_histories();
}

FrameGraph::Scope FrameGraph::enter(std::string_view name, bool cut) {
  return Scope(*this, name, cut);
}

FrameGraph::Scope::Scope(FrameGraph& graph, std::string_view name, bool cut)
    : graph_(graph), outer_(std::exchange(graph.scope_, name)), outer_cut_(std::exchange(graph.cut_, cut)) {}

FrameGraph::Scope::~Scope() {
  graph_.scope_ = outer_;
  graph_.cut_ = outer_cut_;
}

BufferHandle FrameGraph::history_buffer(std::string_view name, std::uint64_t count, std::uint32_t stride, bool& fresh) {
  BufferResource resource{scoped(name), {std::max<std::uint64_t>(count, 1) * stride, stride}, Lifetime::kHistory};
  resource.history.name = resource.name;
  check_new_history(buffers_, resource.name);
  fresh = find_history(context_.history_buffers, resource.name, resource.desc) == nullptr;
  return add_buffer(std::move(resource));
}

ImageHandle FrameGraph::history_image(std::string_view name, const ImageDesc& desc, bool& fresh) {
  ImageNode node{scoped(name), desc, Lifetime::kHistory};
  node.history.name = node.name;
  check_new_history(images_, node.name);
  fresh = find_history(context_.history_images, node.name, desc) == nullptr;
  return add_image(std::move(node));
}

BufferPair FrameGraph::history_pair(std::string_view name, std::uint64_t count, std::uint32_t stride) {
  BufferResource resource{scoped(name), {std::max<std::uint64_t>(count, 1) * stride, stride}, Lifetime::kHistory};
  check_new_history(buffers_, resource.name);
  const auto* state = find_history(context_.history_buffers, resource.name, resource.desc);
  const auto next = static_cast<std::uint32_t>(buffers_.size());
  BufferPair pair;
  for (const bool current : {false, true}) {
    resource.history = make_pair_key(resource.name, state ? state->last_side : 0, next, current);
    (current ? pair.current : pair.previous) = add_buffer(resource);
  }
  pair.valid = !cut_ && state && state->written > 0 && state->written == context_.frames_recorded;
  return pair;
}

ImagePair FrameGraph::history_pair(std::string_view name, const ImageDesc& desc) {
  ImageNode node{scoped(name), desc, Lifetime::kHistory};
  check_new_history(images_, node.name);
  const auto* state = find_history(context_.history_images, node.name, desc);
  const auto next = static_cast<std::uint32_t>(images_.size());
  ImagePair pair;
  for (const bool current : {false, true}) {
    node.history = make_pair_key(node.name, state ? state->last_side : 0, next, current);
    (current ? pair.current : pair.previous) = add_image(node);
  }
  pair.valid = !cut_ && state && state->written > 0 && state->written == context_.frames_recorded;
  return pair;
}

void FrameGraph::note_recorded(const std::vector<bool>& is_alive) {
  recorded_ = true;
  ++context_.frames_recorded;
  std::vector<bool> written_buffers(buffers_.size());
  std::vector<bool> written_images(images_.size());
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    if (!is_alive[i]) continue;
    for (const ResourceUse& use : base_of(passes_[i]).uses)
      if (is_write(use.kind)) (use.is_image ? written_images : written_buffers)[use.index] = true;
  }
  note_histories(buffers_, written_buffers, context_.history_buffers, context_.frames_recorded);
  note_histories(images_, written_images, context_.history_images, context_.frames_recorded);
  for (const std::function<void()>& done : callbacks_) done();
  for (std::size_t i = 0; i < passes_.size(); ++i)
    if (is_alive[i])
      for (const std::function<void()>& done : base_of(passes_[i]).callbacks) done();
}

}  // namespace lightwell
