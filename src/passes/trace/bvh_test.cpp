// The hierarchy as it lies in memory.
#include <algorithm>
#include <functional>
#include <random>

#include "passes/trace/bvh_types.h"
#include "passes/trace/testing/trace_test_base.h"

namespace lightwell {
namespace {

constexpr std::uint32_t kMiss = 0xffffffffu;

// Triangles without connection, each of three vertices of its own.
Scene make_soup(const std::vector<glm::vec3>& corners) {
  Scene scene;
  Primitive primitive;
  primitive.positions = corners;
  primitive.normals.assign(corners.size(), {0, 0, 1});
  for (std::uint32_t i = 0; i < corners.size(); ++i) primitive.indices.push_back(i);
  scene.meshes.push_back({"soup", {primitive}, {}});
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  return scene;
}

struct Box {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};
  void add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

struct Hierarchy {
  std::vector<glm::uvec4> nodes;
  std::vector<glm::uvec4> triangles;
};

struct Walk {
  std::vector<int> seen;  // how often each triangle of the scene
  int outside = 0;        // corners outside a box above them
  int deepest = 0;
  double area_cost = 0.0;  // sum of the nodes' areas over the root's
};

float to_float(std::uint32_t bits) {
  float x;
  std::memcpy(&x, &bits, sizeof(x));
  return x;
}

class Walker {
 public:
  Walker(const Hierarchy& hierarchy, std::size_t triangles) : hierarchy_(hierarchy) { walk_.seen.resize(triangles); }

  Walk walk() {
    for (int root = 0; root < 2; ++root) {
      const std::uint32_t reference = hierarchy_.nodes[0][root];
      if (reference != glsl::kBvhNothing) visit(reference, 0);
    }
    return walk_;
  }

 private:
  Box visit(std::uint32_t reference, int depth) {
    walk_.deepest = std::max(walk_.deepest, depth);
    Box box;
    if ((reference & glsl::kBvhLeafFlag) != 0) {
      const std::uint32_t count = ((reference >> glsl::kBvhLeafCountShift) & 3u) + 1;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t word = glsl::kBvhTriangleWords * std::size_t{(reference & glsl::kBvhSlotMask) + i};
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const glm::uvec4 bits = hierarchy_.triangles.at(word + corner);
          box.add({to_float(bits.x), to_float(bits.y), to_float(bits.z)});
        }
        ++walk_.seen.at(hierarchy_.triangles[word].w);
      }
      return box;
    }
    if (depth > 200) {
      ADD_FAILURE() << "a cycle";
      return box;
    }
    const glm::uvec4* node = &hierarchy_.nodes.at(glsl::kBvhNodeWords * std::size_t{reference});
    for (int child = 0; child < 4; ++child) {
      if (node[3][child] == glsl::kBvhNothing) continue;
      const Box inside = visit(node[3][child], depth + 1);
      for (int axis = 0; axis < 3; ++axis) {
        const float step = to_float(((node[0].w >> (8 * axis)) & 255u) << 23);
        const std::uint32_t low = node[1][axis];
        const std::uint32_t high = axis == 0 ? node[1].w : node[2][axis - 1];
        const float origin = to_float(node[0][axis]);
        if (origin + static_cast<float>((low >> (8 * child)) & 255u) * step > inside.low[axis]) ++walk_.outside;
        if (origin + static_cast<float>((high >> (8 * child)) & 255u) * step < inside.high[axis]) ++walk_.outside;
      }
      box.add(inside.low);
      box.add(inside.high);
    }
    return box;
  }

  const Hierarchy& hierarchy_;
  Walk walk_;
};

class BvhTest : public TraceTest {
 protected:
  Hierarchy fetch_hierarchy(Traced& traced, const SceneSnapshot& snapshot) {
    FrameGraph graph(executor().context());
    const GpuScene::Frame frame = traced.gpu_scene.record(graph, snapshot);
    const Tracer::Frame tracer = traced.tracer.record(graph, frame);
    const ReadbackTicket nodes = graph.read_back(tracer.bvh.nodes);
    const ReadbackTicket triangles = graph.read_back(tracer.bvh.triangles);
    run(graph);
    return {fetch<glm::uvec4>(nodes), fetch<glm::uvec4>(triangles)};
  }
};

struct Soup {
  const char* name;
  std::function<glm::vec3(std::mt19937&, int triangle, int corner)> corner;
};

glm::vec3 random_point(std::mt19937& engine) {
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const float x = uniform(engine);
  const float y = uniform(engine);
  return {x, y, uniform(engine)};
}

const Soup kSoups[] = {
    {"everywhere", [](std::mt19937& e, int, int) { return random_point(e); }},
    {"one_point", [](std::mt19937&, int, int) { return glm::vec3(1, 2, 3); }},
    {"equal", [](std::mt19937&, int, int c) { return glm::vec3(c == 1, c == 2, 0); }},
};

class SoupTest : public BvhTest, public ::testing::WithParamInterface<std::tuple<Soup, int>> {};

TEST_P(SoupTest, HoldsEveryTriangleOnceWithinItsBoxes) {
  const auto& [soup, count] = GetParam();
  constexpr unsigned kSeed = 3;
  std::mt19937 engine(kSeed);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < 3; ++c) corners.push_back(soup.corner(engine, i, c));
  const Scene scene = make_soup(corners);
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const Hierarchy hierarchy = fetch_hierarchy(traced, snapshot);
  const Walk walk = Walker(hierarchy, static_cast<std::size_t>(count)).walk();
  EXPECT_EQ(std::count(walk.seen.begin(), walk.seen.end(), 1), count) << "seed " << kSeed;
  EXPECT_EQ(walk.outside, 0);
}

INSTANTIATE_TEST_SUITE_P(Soups, SoupTest,
                         ::testing::Combine(::testing::ValuesIn(kSoups), ::testing::Values(1, 2, 3, 5, 500, 20000)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) + "_" +
                                  std::to_string(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace lightwell
