// The light volume as published: Mavridis, Gaitatzes and Papaioannou 2010, "Volume-based diffuse global illumination";
// and, for comparison, light propagation volumes (Kaplanyan 2009) on the same grid.
#pragma once

#include "techniques/light_volume/paper_passes.h"
#include "techniques/technique.h"

namespace lightwell {

enum class PaperVariant { kMavridis, kKaplanyan };

struct LightVolumePaperOptions {
  int resolution = 32;
  int steps = 64;            // the source's count for indoor scenes
  float reflectance = 0.5f;  // the source's
};

class LightVolumePaperWorld final : public TechniqueWorld {
 public:
  LightVolumePaperWorld(PaperVariant variant, const LightVolumePaperOptions& options)
      : variant_(variant), options_(options) {}

  void record_world(FrameGraph& graph, WorldFrame& world) override;
  // Irradiance (W/m^2) at each pixel.
  ImageHandle record_lookup(FrameGraph& graph, const GBuffer& gbuffer) const;

 private:
  PaperVariant variant_;
  LightVolumePaperOptions options_;
  // Of this frame.
  VoxelGrid grid_{};
  PaperVolume volume_;
  BufferHandle received_;
};

class LightVolumePaper final : public Technique {
 public:
  explicit LightVolumePaper(PaperVariant variant) : variant_(variant) {}

  void describe(OptionVisitor& visitor) override;
  // The published algorithm cannot tell the light straight from emitters from that which bounced, and does not take in
  // the environment's.
  LightKinds covers(LightKinds) const override { return LightKinds::kBounced | LightKinds::kEmitters; }
  std::unique_ptr<TechniqueWorld> create_world(LightKinds) const override {
    return std::make_unique<LightVolumePaperWorld>(variant_, options_);
  }
  GiResult record_view(FrameGraph& graph, TechniqueWorld* world, ViewFrame& view) override;

 private:
  PaperVariant variant_;
  LightVolumePaperOptions options_;
};

}  // namespace lightwell
