// The light volume as published: Mavridis, Gaitatzes and Papaioannou 2010, "Volume-based diffuse global illumination";
// and, for comparison, light propagation volumes (Kaplanyan 2009) on the same grid.
#pragma once

#include "techniques/technique.h"

namespace lightwell {

struct LightVolumePaperOptions {
  int resolution = 32;
  int steps = 64;            // the source's count for indoor scenes
  float reflectance = 0.5f;  // the source's
};

class LightVolumePaper final : public Technique {
 public:
  enum class Variant { kMavridis, kKaplanyan };
  explicit LightVolumePaper(Variant variant) : variant_(variant) {}

  void describe(OptionVisitor& visitor) override;
  GiResult record(FrameGraph& graph, const FrameInputs& inputs) override;
  bool includes_emitters() const override { return true; }

 private:
  Variant variant_;
  LightVolumePaperOptions options_;
};

}  // namespace lightwell
