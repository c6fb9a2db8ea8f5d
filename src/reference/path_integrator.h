// Light arriving along one camera ray: the rendering equation (Kajiya 1986) estimated with one path.
#pragma once

#include <span>

#include <glm/ext/vector_float3.hpp>

#include "lightwell/scene.h"
#include "reference/bounce_energy.h"
#include "reference/environment.h"
#include "reference/flat_scene.h"
#include "reference/lights.h"
#include "reference/random.h"
#include "reference/ray_tracer.h"

namespace lightwell {

// Everything a path can meet.
struct TracedWorld {
  TracedWorld(const Scene& scene, const SceneSnapshot& snapshot);
  TracedWorld(const TracedWorld&) = delete;
  TracedWorld& operator=(const TracedWorld&) = delete;

  FlatScene flat;
  RayTracer tracer;
  EmissiveTriangles emissive_triangles;
  EnvironmentLight environment;
  std::vector<WorldLight> lights;
};

// Radiance towards the camera in W/(sr m^2), split as in Picture, and what is visible.
struct PathSample {
  glm::vec3 direct{0.0f};
  glm::vec3 indirect{0.0f};
  glm::vec3 emission{0.0f};
  bool hit = false;
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};
  glm::vec3 geometric_normal{0.0f};
  glm::vec3 albedo{0.0f};
};

// `energy`, if any, is told what each bounce brings.
PathSample sample_path(const TracedWorld& world, const Ray& camera_ray, int max_bounces, Sampler& sampler,
                       BounceEnergy* energy = nullptr);

}  // namespace lightwell
