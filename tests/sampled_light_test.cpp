// Sampled direct light of emitters and of the environment against the path tracer and closed forms.
#include <gtest/gtest.h>

#include <string>

#include "graph/testing/device_test.h"
#include "light_frames.h"
#include "lightwell/metrics.h"
#include "lightwell/path_tracer.h"
#include "scene/builtin.h"

namespace lightwell {
namespace {

class SampledLightTest : public DeviceTest {
 protected:
  static Image path_traced(const Scene& scene, const LightFrames& frames, int side, int samples) {
    PathTracerOptions options;
    options.width = side;
    options.height = side;
    options.samples = samples;
    options.max_bounces = 0;
    return PathTracer(scene, frames.world).render(frames.camera, options).direct;
  }
};

TEST_F(SampledLightTest, AnAreaLightsShadowsAreThePathTracers) {
  const Scene scene = load_scene(resolve_scene("cornell-box"));
  LightFrames frames(device(), scene, 128);
  const Image reference = path_traced(scene, frames, 128, 256);
  const Metrics direct = compute_metrics(frames.direct(64, 8), reference);
  EXPECT_NEAR(direct.energy, 1.0, 0.01);
  EXPECT_GE(direct.ssim, 0.97);
}

}  // namespace
}  // namespace lightwell
