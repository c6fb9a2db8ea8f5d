// Vertices that the GPU writes against pose_primitive() on the CPU.
#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "graph/testing/graph_test.h"
#include "passes/gpu_scene/gpu_scene.h"
#include "passes/gpu_scene/gpu_scene_types.h"
#include "scene/pose.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kSeed = 5;

// Diagonal of a part's box beside that of its vertices', at most: turned boxes grow by up to sqrt(3), and joints that
// pull a vertex in two directions leave it in the middle.
constexpr float kLoosest = 6.0f;

class Random {
 public:
  float uniform() { return std::uniform_real_distribution<float>(-1.0f, 1.0f)(engine_); }
  glm::vec3 vector() { return {uniform(), uniform(), uniform()}; }
  glm::vec3 direction() { return glm::normalize(vector() + glm::vec3(0, 0, 1.5f)); }
  std::uint16_t below(std::size_t count) {
    return static_cast<std::uint16_t>(std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_));
  }
  // Turns and moves a little, so that blends of such matrices keep away from flattening vertices.
  glm::mat4 joint(float scale = 1.0f) {
    const glm::mat4 moved = glm::translate(glm::mat4(1), 0.3f * vector());
    return glm::scale(glm::rotate(moved, 0.4f * uniform(), direction()), glm::vec3(scale));
  }

 private:
  std::mt19937 engine_{kSeed};
};

struct Kind {
  std::size_t joints = 0;
  std::size_t targets = 0;
};

// A cloud of random vertices within 1 m; its triangles do not matter here.
Primitive make_primitive(Random& random, std::size_t vertex_count, const Kind& kind) {
  Primitive primitive;
  for (std::size_t i = 0; i < vertex_count; ++i) {
    primitive.positions.push_back(random.vector());
    primitive.normals.push_back(random.direction());
    if (kind.joints == 0) continue;
    glm::vec4 weights = glm::abs(glm::vec4(random.vector(), random.uniform()));
    if (i % 4 == 0) weights = {1, 0, 0, 0};
    if (i % 4 == 1) weights.w = 0.0f;
    primitive.weights.push_back(weights / (weights.x + weights.y + weights.z + weights.w));
    const std::size_t n = kind.joints;
    primitive.joints.push_back({random.below(n), random.below(n), random.below(n), random.below(n)});
  }
  for (std::size_t t = 0; t < kind.targets; ++t) {
    MorphTarget& target = primitive.morph_targets.emplace_back();
    for (std::size_t i = 0; i < vertex_count; ++i) {
      target.positions.push_back(0.2f * random.vector());
      if (t % 2 == 0) target.normals.push_back(0.2f * random.vector());
    }
  }
  for (std::uint32_t i = 0; i + 2 < vertex_count; i += 3)
    for (std::uint32_t k = 0; k < 3; ++k) primitive.indices.push_back(i + k);
  return primitive;
}

// One mesh: a primitive of each kind, each of its own number of vertices.
Scene make_scene(Random& random, const std::vector<Kind>& kinds) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  std::size_t vertex_count = 150;
  for (const Kind& kind : kinds) mesh.primitives.push_back(make_primitive(random, vertex_count += 33, kind));
  return scene;
}

MeshInstance make_instance(Random& random, std::size_t joints, std::size_t targets) {
  MeshInstance instance{0, -1, random.joint(1.5f)};
  for (std::size_t i = 0; i < joints; ++i) instance.joints.push_back(random.joint());
  for (std::size_t i = 0; i < targets; ++i) instance.morph_weights.push_back(random.uniform());
  return instance;
}

class WorldVerticesTest : public GraphTest {
 protected:
  struct Result {
    GpuScene::Frame frame;
    std::vector<glsl::WorldVertex> vertices;
    std::vector<glm::vec4> previous;
    std::vector<std::uint32_t> indices;
    std::vector<PartRange> parts;
  };

  Result show(GpuScene& gpu_scene, const std::vector<MeshInstance>& instances) {
    FrameGraph graph(executor().context());
    Result result;
    result.frame = gpu_scene.record(graph, {instances, {}, {}, {}});
    const ReadbackTicket vertices = graph.read_back(result.frame.vertices);
    const ReadbackTicket previous = graph.read_back(result.frame.previous_positions);
    const ReadbackTicket indices = graph.read_back(result.frame.indices);
    run(graph);
    result.vertices = fetch<glsl::WorldVertex>(vertices);
    result.previous = fetch<glm::vec4>(previous);
    result.indices = fetch<std::uint32_t>(indices);
    result.parts.assign(result.frame.parts.begin(), result.frame.parts.end());
    expect_bounded(result);
    return result;
  }

  // The parts cover all triangles, in order, and their boxes hold every vertex of theirs without being far too large.
  static void expect_bounded(const Result& shown) {
    std::uint32_t first_index = 0;
    for (const PartRange& part : shown.parts) {
      ASSERT_EQ(part.first_index, first_index);
      first_index += part.index_count;
      ASSERT_LE(first_index, shown.indices.size());
      glm::vec3 minimum(std::numeric_limits<float>::infinity());
      glm::vec3 maximum = -minimum;
      for (std::uint32_t i = part.first_index; i < first_index; ++i) {
        const glm::vec3 position(shown.vertices[shown.indices[i]].position_material);
        minimum = glm::min(minimum, position);
        maximum = glm::max(maximum, position);
      }
      EXPECT_TRUE(glm::all(glm::lessThanEqual(part.world_bounds.minimum, minimum)));
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(part.world_bounds.maximum, maximum)));
      EXPECT_LE(glm::distance(part.world_bounds.minimum, part.world_bounds.maximum),
                kLoosest * glm::distance(minimum, maximum));
      EXPECT_EQ(part.moving, part.first_index >= 3 * shown.frame.moving_first &&
                                 part.first_index < 3 * (shown.frame.moving_first + shown.frame.moving_count));
    }
    EXPECT_EQ(first_index, shown.indices.size());
  }

  // Of scenes without animations: rigid world vertices lie before those that may deform, each kind instance by instance
  // and primitive by primitive.
  static void expect_posed(const Scene& scene, const std::vector<MeshInstance>& instances, const Result& shown) {
    std::size_t first_vertex = 0;
    for (const bool deformable : {false, true}) {
      for (const MeshInstance& instance : instances) {
        for (const Primitive& primitive : scene.meshes[0].primitives) {
          if ((primitive.joints.empty() && primitive.morph_targets.empty()) == deformable) continue;
          ASSERT_LE(first_vertex + primitive.positions.size(), shown.vertices.size());
          expect_primitive_posed(primitive, instance, &shown.vertices[first_vertex]);
          first_vertex += primitive.positions.size();
        }
      }
    }
    EXPECT_EQ(first_vertex, shown.vertices.size());
  }

  static void expect_primitive_posed(const Primitive& primitive, const MeshInstance& instance,
                                     const glsl::WorldVertex* vertices) {
    const PosedVertices posed = pose_primitive(primitive, instance);
    float size = 0.0f;
    for (const glm::vec3& p : posed.positions) size = std::max(size, glm::length(p));
    float position_error = 0.0f;
    float normal_error = 0.0f;
    for (std::size_t i = 0; i < posed.positions.size(); ++i) {
      const glm::vec3 position(vertices[i].position_material);
      const glm::vec3 normal(vertices[i].normal_u);
      position_error = std::max(position_error, glm::distance(position, posed.positions[i]));
      normal_error = std::max(normal_error, glm::distance(normal, posed.normals[i]));
      ASSERT_EQ(vertices[i].v_uv1.w, is_mirrored(primitive, instance) ? -1.0f : 1.0f);
    }
    EXPECT_LE(position_error, 1e-5f * size);
    EXPECT_LE(normal_error, 1e-5f);
  }

  void expect_posed(const Scene& scene, const std::vector<MeshInstance>& instances) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    GpuScene gpu_scene(device(), scene, {instances, {}, {}, {}});
    const Result shown = show(gpu_scene, instances);
    expect_posed(scene, instances, shown);
  }

  Random random_;
};

TEST_F(WorldVerticesTest, RigidPrimitives) {
  const Scene scene = make_scene(random_, {{}, {}});
  expect_posed(scene, {make_instance(random_, 0, 0), {0, -1, glm::scale(glm::mat4(1), glm::vec3(1, -2, 0.5f))}});
}

TEST_F(WorldVerticesTest, SkinnedPrimitives) {
  const Scene scene = make_scene(random_, {{.joints = 7}});
  expect_posed(scene, {make_instance(random_, 7, 0)});
}

TEST_F(WorldVerticesTest, MorphedPrimitives) {
  const Scene scene = make_scene(random_, {{.targets = 3}});
  expect_posed(scene, {make_instance(random_, 0, 3)});
}

// Of all kinds in one mesh, shown in three poses; those without joints follow the node.
TEST_F(WorldVerticesTest, InstancesOfOneMeshInPosesOfTheirOwn) {
  const Scene scene = make_scene(random_, {{.joints = 5, .targets = 4}, {}, {.targets = 4}, {.joints = 5}});
  expect_posed(scene, {make_instance(random_, 5, 4), make_instance(random_, 5, 4), make_instance(random_, 0, 4)});
}

TEST_F(WorldVerticesTest, WeightsThatAreZeroOrMissing) {
  const Scene scene = make_scene(random_, {{.targets = 3}, {.joints = 2, .targets = 3}});
  std::vector<MeshInstance> instances{make_instance(random_, 2, 3), make_instance(random_, 2, 1),
                                      make_instance(random_, 2, 0)};
  instances[0].morph_weights[1] = 0.0f;
  expect_posed(scene, instances);
}

TEST_F(WorldVerticesTest, MirroredAndScaledJoints) {
  const Scene scene = make_scene(random_, {{.joints = 6, .targets = 1}, {.joints = 3}});
  std::vector<MeshInstance> instances(3, make_instance(random_, 6, 1));
  for (std::size_t i = 0; i < 6; ++i) {
    instances[0].joints[i] = instances[0].joints[i] * glm::scale(glm::mat4(1), glm::vec3(1, 1, -1));
    instances[1].joints[i] = instances[1].joints[i] * glm::scale(glm::mat4(1), glm::vec3(1e-3f, 2e-3f, 1e-3f));
    instances[2].joints[i] = glm::scale(glm::mat4(1), glm::vec3(-300, 100, 200)) * instances[2].joints[i];
  }
  expect_posed(scene, instances);
}

TEST_F(WorldVerticesTest, ThousandsOfJoints) {
  const Scene scene = make_scene(random_, {{.joints = 5000}, {.joints = 65535}});
  expect_posed(scene, {make_instance(random_, 65535, 0), make_instance(random_, 65535, 0)});
}

TEST_F(WorldVerticesTest, ASkinIgnoresItsNode) {
  const Scene scene = make_scene(random_, {{.joints = 2}});
  std::vector<MeshInstance> instances{make_instance(random_, 2, 0)};
  GpuScene gpu_scene(device(), scene, {instances, {}, {}, {}});
  const Result first = show(gpu_scene, instances);
  instances[0].to_world = glm::translate(glm::mat4(1), glm::vec3(5));
  const Result second = show(gpu_scene, instances);
  EXPECT_EQ(second.frame.revisions.moving_geometry, first.frame.revisions.moving_geometry);
  expect_posed(scene, instances, second);
}

// Four frames: joints move, weights change, nothing happens, both. What moves for the first time joins the moving.
TEST_F(WorldVerticesTest, PreviousPositionsAreThoseOfTheLastPose) {
  const Scene scene = make_scene(random_, {{.joints = 4}, {.targets = 2}, {}});
  std::vector<MeshInstance> instances{make_instance(random_, 4, 2), make_instance(random_, 4, 2)};
  GpuScene gpu_scene(device(), scene, {instances, {}, {}, {}});
  Result last = show(gpu_scene, instances);
  EXPECT_EQ(last.frame.moving_count, 0u);
  std::size_t moving_indices = 0;
  for (int frame = 0; frame < 4; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    if (frame == 0 || frame == 3) instances[1].joints[2] = random_.joint();
    if (frame == 1 || frame == 3) instances[1].morph_weights[1] = random_.uniform();
    if (frame < 2) moving_indices += scene.meshes[0].primitives[static_cast<std::size_t>(frame)].indices.size();
    const Result now = show(gpu_scene, instances);
    expect_posed(scene, instances, now);
    for (std::size_t i = 0; i < now.vertices.size(); ++i)
      ASSERT_EQ(glm::vec3(now.previous[i]), glm::vec3(last.vertices[i].position_material)) << "vertex " << i;
    EXPECT_EQ(now.frame.revisions.moving_geometry != last.frame.revisions.moving_geometry, frame != 2);
    EXPECT_EQ(now.frame.revisions.static_geometry != last.frame.revisions.static_geometry, frame < 2);
    EXPECT_EQ(now.frame.moving_count, moving_indices / 3);
    last = now;
  }
}

TEST_F(WorldVerticesTest, SamePoseSameBytes) {
  const Scene scene = make_scene(random_, {{.joints = 9, .targets = 3}});
  const std::vector<MeshInstance> instances{make_instance(random_, 9, 3)};
  GpuScene a(device(), scene, {instances, {}, {}, {}});
  const std::vector<glsl::WorldVertex> first = show(a, instances).vertices;
  GpuScene b(device(), scene, {instances, {}, {}, {}});
  const std::vector<glsl::WorldVertex> second = show(b, instances).vertices;
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(glsl::WorldVertex)), 0);
}

// Vertices in three pages, morph offsets in two.
TEST_F(WorldVerticesTest, BuffersInPages) {
  executor().context().descriptor_range = std::uint64_t{16} << 10;
  const Scene scene = make_scene(random_, {{.joints = 5, .targets = 4}, {}, {.joints = 5}});
  expect_posed(scene, {make_instance(random_, 5, 4)});
}

}  // namespace
}  // namespace lightwell
