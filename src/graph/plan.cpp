#include "graph/plan.h"

#include <algorithm>

#include "lightwell/error.h"

namespace lightwell {

bool is_write(UseKind kind) {
  return kind == UseKind::kStorageWrite || kind == UseKind::kColorAttachment || kind == UseKind::kDepthAttachment ||
         kind == UseKind::kTransferWrite || kind == UseKind::kAccelerationStructureBuild;
}

namespace {

// Passes that use a resource first and last.
struct Life {
  std::uint32_t first = UINT32_MAX;
  std::uint32_t last = 0;
};

// Greedy interval colouring in order of first use: take the first free slot of the same description.
template <class Desc>
std::vector<std::uint32_t> assign_slots(const std::vector<Life>& lives, const std::vector<const Desc*>& descs,
                                        std::vector<Desc>& pool) {
  std::vector<std::uint32_t> slots(lives.size(), UINT32_MAX);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < lives.size(); ++i)
    if (descs[i] && lives[i].first != UINT32_MAX) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return lives[a].first < lives[b].first; });
  std::vector<std::uint32_t> busy_until;
  for (const std::uint32_t i : order) {
    std::uint32_t slot = 0;
    while (slot < pool.size() && !(pool[slot] == *descs[i] && busy_until[slot] < lives[i].first)) ++slot;
    if (slot == pool.size()) {
      pool.push_back(*descs[i]);
      busy_until.push_back(0);
    }
    busy_until[slot] = lives[i].last;
    slots[i] = slot;
  }
  return slots;
}

bool overlap(Subresource a, Subresource b) {
  const auto meet = [](std::uint32_t i, std::uint32_t j) {
    return i == j || i == Subresource::kAll || j == Subresource::kAll;
  };
  return meet(a.mip, b.mip) && meet(a.layer, b.layer);
}

// Equal uses of one resource become one, for all their stages. A resource may be read in several ways in one pass, but
// what is written is used in one way only.
std::vector<ResourceUse> merge_uses(const PassBase& pass) {
  std::vector<ResourceUse> merged;
  for (const ResourceUse& use : pass.uses) {
    bool absorbed = false;
    for (ResourceUse& other : merged) {
      if (other.is_image != use.is_image || other.index != use.index || !overlap(other.part, use.part)) continue;
      const UseInfo a = describe_use(other);
      const UseInfo b = describe_use(use);
      LW_ASSERT(other.kind == use.kind || (!a.writes && !b.writes),
                pass.name + ": a resource is both read and written");
      LW_ASSERT(a.layout == b.layout, pass.name + ": an image is used in two layouts");
      if (other.kind != use.kind || !(other.part == use.part)) continue;
      other.stages |= use.stages;
      absorbed = true;
    }
    if (!absorbed) merged.push_back(use);
  }
  return merged;
}

// Which passes lead to a root, from the last one backwards. A pass that writes something needed runs, and then all that
// it uses is needed; what it wholly overwrites is no longer needed before it.
class Culling {
 public:
  explicit Culling(const FrameGraph& graph)
      : graph_(graph), needed_buffers_(graph.buffers().size()), needed_images_(graph.images().size()) {
    // The next frame will want to read what this one's readers of the past read now.
    for (const Pass& pass : graph.passes()) {
      for (const ResourceUse& use : base_of(pass).uses) {
        const HistoryKey& key = history(use);
        if (key.is_pair && !key.is_current) (use.is_image ? needed_images_ : needed_buffers_)[key.partner] = true;
      }
    }
  }

  std::vector<bool> run() {
    std::vector<bool> is_alive(graph_.passes().size());
    for (std::size_t i = is_alive.size(); i-- > 0;) {
      const PassBase& pass = base_of(graph_.passes()[i]);
      is_alive[i] = std::any_of(pass.uses.begin(), pass.uses.end(), [&](const ResourceUse& use) {
        return is_write(use.kind) && (outlives_frame(use) || needed(use));
      });
      if (!is_alive[i]) continue;
      for (const ResourceUse& use : pass.uses) needed(use) = true;
      for (const ResourceUse& use : pass.uses)
        if (use.discards && use.part == kWholeImage) needed(use) = false;
    }
    return is_alive;
  }

 private:
  const HistoryKey& history(const ResourceUse& use) const {
    return use.is_image ? graph_.images()[use.index].history : graph_.buffers()[use.index].history;
  }

  // Whoever reads it now.
  bool outlives_frame(const ResourceUse& use) const {
    const Lifetime lifetime = use.is_image ? graph_.images()[use.index].lifetime : graph_.buffers()[use.index].lifetime;
    return lifetime == Lifetime::kImported || lifetime == Lifetime::kReadback ||
           (lifetime == Lifetime::kHistory && !history(use).is_pair);
  }

  std::vector<bool>::reference needed(const ResourceUse& use) {
    return (use.is_image ? needed_images_ : needed_buffers_)[use.index];
  }

  const FrameGraph& graph_;
  std::vector<bool> needed_buffers_, needed_images_;  // by passes from where the sweep has come to
};

}  // namespace

UseInfo describe_use(const ResourceUse& use) {
  UseInfo info;
  info.stages = use.stages;
  info.writes = is_write(use.kind);
  switch (use.kind) {
    case UseKind::kUniformRead:
      info.access = VK_ACCESS_2_UNIFORM_READ_BIT;
      break;
    case UseKind::kStorageRead:
      info.access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
      info.layout = VK_IMAGE_LAYOUT_GENERAL;
      break;
    case UseKind::kStorageWrite:
      info.access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
      info.layout = VK_IMAGE_LAYOUT_GENERAL;
      break;
    case UseKind::kSampled:
      info.access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
      info.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
      break;
    case UseKind::kColorAttachment:
      info.access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
      info.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
      info.stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
      break;
    case UseKind::kDepthAttachment:
      info.access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
      info.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
      info.stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
      break;
    case UseKind::kTransferRead:
      info.access = VK_ACCESS_2_TRANSFER_READ_BIT;
      info.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
      info.stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
      break;
    case UseKind::kTransferWrite:
      info.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
      info.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
      info.stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
      break;
    case UseKind::kIndirectRead:
      info.access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;
      info.stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
      break;
    case UseKind::kIndexRead:
      info.access = VK_ACCESS_2_INDEX_READ_BIT;
      info.stages = VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT;
      break;
    case UseKind::kAccelerationStructureRead:
      info.access = VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
      break;
    case UseKind::kAccelerationStructureBuild:
      info.access = VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
      info.stages = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
      break;
    case UseKind::kBuildInput:
      info.access = VK_ACCESS_2_SHADER_READ_BIT;
      info.stages = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
      break;
  }
  if (!use.is_image) info.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return info;
}

bool advance(ResourceState& state, const UseInfo& use, bool is_image, Barrier& barrier) {
  const bool relayout = is_image && use.layout != state.layout;
  const bool used_before = state.write_stages != 0 || state.read_stages != 0;
  bool needed = relayout;
  barrier = {};
  barrier.is_image = is_image;
  if (use.writes || relayout) {
    // After everything before it. Reads need no memory made available, only to be over.
    needed |= used_before;
    barrier.from_stages = state.write_stages | state.read_stages;
    barrier.from_access = state.write_access;
  } else if (state.write_stages != 0 &&
             ((use.stages & ~state.read_stages) != 0 || (use.access & ~state.read_access) != 0)) {
    needed = true;
    barrier.from_stages = state.write_stages;
    barrier.from_access = state.write_access;
  }
  barrier.to_stages = use.stages;
  barrier.to_access = use.access;
  barrier.from_layout = state.layout;
  barrier.to_layout = is_image ? use.layout : VK_IMAGE_LAYOUT_UNDEFINED;

  if (is_image) state.layout = use.layout;
  if (use.writes) {
    state.write_stages = use.stages;
    state.write_access = use.access;
    state.read_stages = 0;
    state.read_access = 0;
  } else if (relayout) {
    // A layout transition is a write that this use's stages already see.
    state.write_stages = use.stages;
    state.write_access = 0;
    state.read_stages = use.stages;
    state.read_access = use.access;
  } else {
    state.read_stages |= use.stages;
    state.read_access |= use.access;
  }
  return needed;
}

void advance(ImageState& state, const ImageDesc& desc, const UseInfo& use, Subresource part,
             std::vector<Barrier>& barriers) {
  const bool is_all =
      (part.mip == Subresource::kAll || desc.mips == 1) && (part.layer == Subresource::kAll || desc.layers == 1);
  Barrier barrier;
  if (is_all && state.parts.empty()) {
    if (advance(state.whole, use, true, barrier)) barriers.push_back(barrier);
    return;
  }
  if (state.parts.empty()) state.parts.assign(std::size_t{desc.mips} * desc.layers, state.whole);
  for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
    if (part.mip != Subresource::kAll && part.mip != mip) continue;
    for (std::uint32_t layer = 0; layer < desc.layers; ++layer) {
      if (part.layer != Subresource::kAll && part.layer != layer) continue;
      if (!advance(state.parts[std::size_t{mip} * desc.layers + layer], use, true, barrier)) continue;
      barrier.part = {mip, layer};
      barriers.push_back(barrier);
    }
  }
  if (!std::all_of(state.parts.begin(), state.parts.end(), [&](const ResourceState& s) { return s == state.parts[0]; }))
    return;
  state.whole = state.parts[0];
  state.parts.clear();
}

Plan make_plan(const FrameGraph& graph) {
  Plan plan;
  plan.is_alive = Culling(graph).run();
  std::vector<Life> buffer_lives(graph.buffers().size());
  std::vector<Life> image_lives(graph.images().size());
  for (std::uint32_t number = 0; number < graph.passes().size(); ++number) {
    const PassBase& pass = base_of(graph.passes()[number]);
    plan.pass_uses.push_back(merge_uses(pass));
    if (!plan.is_alive[number]) continue;
    for (const ResourceUse& use : plan.pass_uses.back()) {
      Life& life = use.is_image ? image_lives[use.index] : buffer_lives[use.index];
      if (life.first == UINT32_MAX) {
        const bool transient = use.is_image ? graph.images()[use.index].lifetime == Lifetime::kTransient
                                            : graph.buffers()[use.index].lifetime == Lifetime::kTransient;
        const std::string& name = use.is_image ? graph.images()[use.index].name : graph.buffers()[use.index].name;
        LW_ASSERT(!transient || is_write(use.kind), pass.name + " reads " + name + ", which nothing wrote");
        life.first = number;
      }
      life.last = number;
    }
  }
  std::vector<const BufferDesc*> buffers;
  for (const BufferResource& b : graph.buffers())
    buffers.push_back(b.lifetime == Lifetime::kTransient ? &b.desc : nullptr);
  std::vector<const ImageDesc*> images;
  for (const ImageNode& i : graph.images()) images.push_back(i.lifetime == Lifetime::kTransient ? &i.desc : nullptr);
  plan.buffer_slots = assign_slots(buffer_lives, buffers, plan.buffer_pool);
  plan.image_slots = assign_slots(image_lives, images, plan.image_pool);
  return plan;
}

}  // namespace lightwell
