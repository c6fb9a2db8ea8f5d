#include "techniques/photon_splatting/photon_guide.h"

#include "kernels/techniques/photon_splatting/guide_update.comp.h"
#include "kernels/techniques/photon_splatting/guide_vote.comp.h"
#include "passes/light_paths/light_path_guide.h"
#include "techniques/photon_splatting/guide_types.h"
#include "techniques/photon_splatting/photon_types.h"

namespace lightwell {
namespace {

constexpr float kKept = 0.9f;  // of earlier frames' counts

bool lights_changed(const SceneRevisions& a, const SceneRevisions& b) {
  return a.lights != b.lights || a.environment != b.environment || a.static_geometry != b.static_geometry ||
         a.materials != b.materials;
}

}  // namespace

bool PhotonGuide::begin(FrameGraph& graph, WorldFrame& world) {
  const std::uint32_t sources = world.lights.count + 2;
  is_active_ = sources <= glsl::kMostGuidedSources;
  if (!is_active_) return false;
  bool fresh_counts = false, fresh_sums = false;
  const std::uint32_t strata = sources * glsl::kGuideStrata;
  guide_.counts = graph.history_buffer("photon guide counts", strata, sizeof(glm::uvec2), fresh_counts);
  BufferHandle sums = graph.history_buffer("photon guide sums", strata, sizeof(glm::vec2), fresh_sums);
  guide_.table = graph.create_buffer("photon guide", sources * glsl::kGuideFloats, sizeof(float));
  const bool forgets = fresh_counts || fresh_sums || world.is_cut || lights_changed(revisions_, world.revisions);
  revisions_ = world.revisions;
  graph.compute("photon splatting: guide", kernels::photon_splatting_guide_update_comp)
      .write("counts", guide_.counts)
      .write("sums", sums)
      .write("table", guide_.table)
      .push(glsl::GuideUpdateParams{.keep = forgets ? 0.0f : kKept, .counted = forgets ? 0.0f : 1.0f})
      .dispatch(sources);
  return true;
}

void PhotonGuide::vote(FrameGraph& graph, const SplatScreen& screen, const Splats& splats, BufferHandle strata) {
  if (!is_active_) return;
  constexpr std::uint64_t kSplatGroupsOffset = glsl::kSplatGroups * sizeof(std::uint32_t);
  graph.compute("photon splatting: guide", kernels::photon_splatting_guide_vote_comp)
      .read("splats", splats.splats)
      .read("splat_counts", splats.counts)
      .read("camera", screen.camera_buffer)
      .read("position", screen.gbuffer.position)
      .read("strata", strata)
      .write("counts", guide_.counts)
      .dispatch_indirect(splats.counts, kSplatGroupsOffset);
}

}  // namespace lightwell
