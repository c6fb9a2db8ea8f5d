// The hierarchy as it lies in memory.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

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

glm::vec3 random_point(std::mt19937& engine) {
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const float x = uniform(engine);
  const float y = uniform(engine);
  return {x, y, uniform(engine)};
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

// How a ray meets a triangle, in double precision (Moeller and Trumbore 1997).
struct Meeting {
  double t = 0.0;
  double inside = -1.0;   // smallest barycentric weight
  bool is_steep = false;  // neither a grazing ray nor a needle, where rounding moves the point of intersection far
};

Meeting meet(const glm::vec3* corners, const glsl::ListedRay& ray) {
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 e1 = glm::dvec3(corners[1]) - a;
  const glm::dvec3 e2 = glm::dvec3(corners[2]) - a;
  const glm::dvec3 direction(ray.direction);
  const glm::dvec3 p = glm::cross(direction, e2);
  const double determinant = glm::dot(e1, p);
  const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e1 - e2)});
  if (determinant == 0.0) return {};
  const glm::dvec3 s = glm::dvec3(ray.origin) - a;
  const glm::dvec3 q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant;
  const double v = glm::dot(direction, q) / determinant;
  return {glm::dot(e2, q) / determinant, std::min({u, v, 1.0 - u - v}),
          std::abs(determinant) > 1e-2 * longest * longest * glm::length(direction)};
}

// Whether `hit` is an answer: nothing is surely before it, and it is there itself. Rounding may decide whether the ray
// passes an edge and which of two that are close comes first, but not more.
bool agrees(const std::vector<glm::vec3>& corners, const glsl::ListedRay& ray, const glsl::ListedHit& hit) {
  constexpr double kMargin = 1e-3;
  constexpr double kApart = 1e-3;
  double first_sure = ray.t_max;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Meeting meeting = meet(&corners[i], ray);
    if (meeting.is_steep && meeting.inside > kMargin && meeting.t > kApart)
      first_sure = std::min(first_sure, meeting.t);
  }
  if (hit.triangle == kMiss) return first_sure > ray.t_max - kApart;
  const Meeting here = meet(&corners[3 * std::size_t{hit.triangle}], ray);
  const bool is_there = !here.is_steep || (here.inside > -kMargin && std::abs(here.t - hit.t) <= kApart);
  return is_there && hit.t <= first_sure + kApart;
}

// Towards points of triangles, from outside and from among them; t is about 1 there. Half of them are parallel to an
// axis in one component or two.
std::vector<glsl::ListedRay> rays_at(const std::vector<glm::vec3>& corners, unsigned seed, int count) {
  std::mt19937 engine(seed);
  std::uniform_int_distribution<std::size_t> triangle(0, corners.size() / 3 - 1);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Box bounds;
  for (const glm::vec3& corner : corners) bounds.add(corner);
  std::vector<glsl::ListedRay> rays;
  for (int i = 0; i < count; ++i) {
    const glm::vec3* at = &corners[3 * triangle(engine)];
    const float u = unit(engine);
    const float v = unit(engine) * (1.0f - u);
    const glm::vec3 target = (1.0f - u - v) * at[0] + u * at[1] + v * at[2];
    const glm::vec3 size = glm::max(bounds.high - bounds.low, glm::vec3(1e-12f));
    glm::vec3 origin = 0.5f * (bounds.low + bounds.high) + random_point(engine) * size;
    if (i % 2 == 0) origin[i / 2 % 3] = target[i / 2 % 3];
    if (i % 4 == 0) origin[(i / 2 + 1) % 3] = target[(i / 2 + 1) % 3];
    if (origin == target) origin.x += size.x;
    rays.push_back({origin, 0.0f, target - origin, i % 8 == 0 ? 0.5f : 1e6f});
  }
  return rays;
}

class BvhTest : public TraceTest {
 protected:
  // The nodes that are reached, one after the other; others are memory that nobody wrote.
  static std::vector<glm::uvec4> used_nodes(const Hierarchy& hierarchy) {
    std::vector<glm::uvec4> used;
    std::vector<std::uint32_t> open{hierarchy.nodes[0].x, hierarchy.nodes[0].y};
    while (!open.empty()) {
      const std::uint32_t reference = open.back();
      open.pop_back();
      if ((reference & glsl::kBvhLeafFlag) != 0) continue;
      const auto node = hierarchy.nodes.begin() + static_cast<std::ptrdiff_t>(glsl::kBvhNodeWords * reference);
      used.insert(used.end(), node, node + glsl::kBvhNodeWords);
      for (int child = 0; child < 4; ++child) open.push_back(node[3][child]);
    }
    return used;
  }

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

// The same place for the same triangle, anywhere in [-1, 1]^3.
glm::vec3 spread(int triangle) {
  std::mt19937 engine(static_cast<unsigned>(triangle));
  return random_point(engine);
}

// On lattice points; every third triangle lies across an axis.
glm::vec3 on_grid(const glm::vec3& p, int triangle) {
  glm::vec3 corner = glm::round(4.0f * p) / 4.0f;
  corner[triangle % 3] = glm::round(4.0f * spread(triangle).x) / 4.0f;
  return corner;
}

constexpr glm::vec3 kUnit[] = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}};

// Soups in which builders or rays have gone wrong.
const Soup kSoups[] = {
    {"everywhere", [](std::mt19937& e, int, int) { return random_point(e); }},
    {"small", [](std::mt19937& e, int t, int) { return 0.02f * random_point(e) + spread(t); }},
    {"far_away", [](std::mt19937& e, int t, int) { return 0.02f * random_point(e) + spread(t) + 1000.0f; }},
    {"huge", [](std::mt19937& e, int t, int) { return 1e12f * (0.02f * random_point(e) + spread(t)); }},
    {"tiny", [](std::mt19937& e, int t, int) { return 1e-9f * (0.02f * random_point(e) + spread(t)); }},
    {"flat", [](std::mt19937& e, int, int) { return random_point(e) * glm::vec3(1, 0, 1); }},
    {"walls", [](std::mt19937& e, int t, int) { return on_grid(random_point(e), t); }},
    {"one_point", [](std::mt19937&, int, int) { return glm::vec3(1, 2, 3); }},
    {"equal", [](std::mt19937&, int, int c) { return glm::vec3(c == 1, c == 2, 0); }},
    {"needles", [](std::mt19937& e, int t, int c) { return spread(t) + (c == 2 ? 1.0f : 1e-6f) * random_point(e); }},
    // Each triangle outgrows all before it: every round of merging makes one pair.
    {"doubling", [](std::mt19937&, int t, int c) { return std::exp2(0.08f * static_cast<float>(t % 150)) * kUnit[c]; }},
};

void PrintTo(const Soup& soup, std::ostream* out) {
  *out << soup.name;
}

class SoupTest : public BvhTest, public ::testing::WithParamInterface<std::tuple<Soup, int>> {
 protected:
  static constexpr unsigned kSeed = 3;

  std::vector<glm::vec3> make_corners() const {
    const auto& [soup, count] = GetParam();
    std::mt19937 engine(kSeed);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < 3; ++c) corners.push_back(soup.corner(engine, i, c));
    return corners;
  }
};

TEST_P(SoupTest, HoldsEveryTriangleOnceWithinItsBoxesAndIsTheSameEveryTime) {
  const int count = std::get<1>(GetParam());
  const Scene scene = make_soup(make_corners());
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const Hierarchy hierarchy = fetch_hierarchy(traced, snapshot);
  const Walk walk = Walker(hierarchy, static_cast<std::size_t>(count)).walk();
  EXPECT_EQ(std::count(walk.seen.begin(), walk.seen.end(), 1), count) << "seed " << kSeed;
  EXPECT_EQ(walk.outside, 0);
  EXPECT_LE(3 * walk.deepest + 4, static_cast<int>(glsl::kBvhStack));

  Traced again(scene, snapshot);
  const Hierarchy second = fetch_hierarchy(again, snapshot);
  EXPECT_TRUE(hierarchy.triangles == second.triangles);
  EXPECT_EQ(used_nodes(hierarchy), used_nodes(second));
}

TEST_P(SoupTest, MeetsWhatAllTrianglesOneByOneMeet) {
  const std::vector<glm::vec3> corners = make_corners();
  const Scene scene = make_soup(corners);
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const std::vector<glsl::ListedRay> rays = rays_at(corners, kSeed, 6000000 / static_cast<int>(corners.size() + 5000));
  const std::vector<glsl::ListedHit> closest = trace(traced, snapshot, rays);
  const std::vector<glsl::ListedHit> any = trace(traced, snapshot, rays, true);
  int other = 0;
  int half_blocked = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    half_blocked += (any[i].triangle == kMiss) != (closest[i].triangle == kMiss) ? 1 : 0;
    other += agrees(corners, rays[i], closest[i]) ? 0 : 1;
  }
  EXPECT_EQ(half_blocked, 0) << "seed " << kSeed;
  EXPECT_EQ(other, 0) << "of " << rays.size();
}

INSTANTIATE_TEST_SUITE_P(Soups, SoupTest,
                         ::testing::Combine(::testing::ValuesIn(kSoups), ::testing::Values(1, 3, 500, 20000)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param).name) + "_" +
                                  std::to_string(std::get<1>(info.param));
                         });

// A sheet of 2 x 20 x 20 triangles in the plane z = 0, whose corners do not lie on round numbers.
Scene make_sheet() {
  constexpr std::uint32_t kSide = 21;
  Scene scene = make_soup({});
  Primitive& sheet = scene.meshes[0].primitives[0];
  std::mt19937 engine(1);
  MorphTarget waves;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    const glm::vec3 p(static_cast<float>(i % kSide), static_cast<float>(i / kSide), 0.0f);
    sheet.positions.push_back(p + 0.3f * random_point(engine) * glm::vec3(1, 1, 0));
    sheet.normals.emplace_back(0, 0, 1);
    waves.positions.push_back(5.0f * random_point(engine));
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      for (const std::uint32_t corner : {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide})
        sheet.indices.push_back(corner);
    }
  }
  waves.normals.resize(waves.positions.size());
  sheet.morph_targets.push_back(waves);
  scene.meshes[0].morph_weights = {0.0f};
  return scene;
}

// A point inside the sheet's `i`th edge, or a corner of it.
glm::vec3 on_edge(const Primitive& sheet, std::size_t i, float part) {
  const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
  return glm::mix(sheet.positions[sheet.indices[i]], sheet.positions[sheet.indices[next]], part);
}

TEST_F(BvhTest, NoRaySlipsBetweenTrianglesThatShareAnEdge) {
  const Scene scene = make_sheet();
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const Primitive& sheet = scene.meshes[0].primitives[0];
  constexpr unsigned kSeed = 7;
  std::mt19937 engine(kSeed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<glsl::ListedRay> rays;
  while (rays.size() < 200000) {
    const glm::vec3 target =
        on_edge(sheet, engine() % sheet.indices.size(), rays.size() % 4 == 0 ? 0.0f : unit(engine));
    // Not at the border, behind which there is nothing.
    if (glm::any(glm::lessThan(glm::vec2(target), glm::vec2(0.7f))) ||
        glm::any(glm::greaterThan(glm::vec2(target), glm::vec2(19.3f))))
      continue;
    const glm::vec3 from =
        glm::vec3(target.x, target.y, 10.0f) + (rays.size() % 2 == 0 ? glm::vec3(0) : 8.0f * random_point(engine));
    rays.push_back({from, 0.0f, target - from, 10.0f});
  }
  const std::vector<glsl::ListedHit> hits = trace(traced, snapshot, rays);
  EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.triangle == kMiss; }), 0)
      << "seed " << kSeed;
}

// The answer belongs to the triangles, not to the way they were grouped: refitted hierarchies, some of them far from
// what a build would have made, give the same bytes as new ones.
TEST_F(BvhTest, ARefittedHierarchyAnswersLikeANewOne) {
  const Scene scene = make_sheet();
  SceneSnapshot snapshot = take_snapshot(scene);
  Traced moving(scene, snapshot);
  constexpr unsigned kSeed = 9;
  std::mt19937 engine(kSeed);
  std::vector<glsl::ListedRay> rays;
  for (int i = 0; i < 20000; ++i)
    rays.push_back({glm::vec3(10, 10, 0) + 12.0f * random_point(engine), 0.0f, random_point(engine), 1000.0f});
  const auto pose = [&](int frame) { snapshot.instances[0].morph_weights = {0.1f * static_cast<float>(frame)}; };
  constexpr int kFrames = 20;
  std::vector<std::vector<glsl::ListedHit>> refitted;
  for (int frame = 0; frame <= kFrames; ++frame) {
    pose(frame);
    refitted.push_back(trace(moving, snapshot, rays));
    const Walk walk = Walker(fetch_hierarchy(moving, snapshot), 800).walk();
    EXPECT_EQ(walk.outside, 0) << "frame " << frame;
    EXPECT_EQ(std::count(walk.seen.begin(), walk.seen.end(), 1), 800) << "frame " << frame;
  }
  for (int frame = 0; frame <= kFrames; frame += 4) {
    pose(frame);
    Traced fresh(scene, snapshot);
    const std::vector<glsl::ListedHit> built = trace(fresh, snapshot, rays);
    EXPECT_EQ(
        std::memcmp(refitted[static_cast<std::size_t>(frame)].data(), built.data(), rays.size() * sizeof(built[0])), 0)
        << "frame " << frame << ", seed " << kSeed;
  }
}

TEST_F(BvhTest, TrianglesThatAreNotFiniteAreNeverMetAndHideNothing) {
  constexpr unsigned kSeed = 13;
  std::mt19937 engine(kSeed);
  std::vector<glm::vec3> corners;
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(), 3e38f};
  for (int i = 0; i < 3 * 3000; ++i) {
    corners.push_back(random_point(engine));
    if (i / 3 % 2 == 1 && i % 3 == 1) corners.back()[i % 7 % 3] = bad[i % 4];
  }
  const Scene scene = make_soup(corners);
  const SceneSnapshot snapshot = take_snapshot(scene);
  Traced traced(scene, snapshot);
  const Walk walk = Walker(fetch_hierarchy(traced, snapshot), 3000).walk();
  EXPECT_EQ(std::count(walk.seen.begin(), walk.seen.end(), 1), 3000) << "seed " << kSeed;
  EXPECT_EQ(walk.outside, 0);

  std::vector<glm::vec3> finite;
  for (std::size_t i = 0; i < corners.size(); i += 6) finite.insert(finite.end(), &corners[i], &corners[i] + 3);
  const std::vector<glsl::ListedRay> rays = rays_at(finite, kSeed, 2000);
  const std::vector<glsl::ListedHit> hits = trace(traced, snapshot, rays);
  const Scene finite_scene = make_soup(finite);
  const SceneSnapshot finite_snapshot = take_snapshot(finite_scene);
  Traced finite_traced(finite_scene, finite_snapshot);
  const std::vector<glsl::ListedHit> expected = trace(finite_traced, finite_snapshot, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(hits[i].t, expected[i].t) << "ray " << i << ", seed " << kSeed;
    ASSERT_EQ(hits[i].triangle, expected[i].triangle == kMiss ? kMiss : 2 * expected[i].triangle) << "ray " << i;
  }
}

TEST_F(BvhTest, AnEmptySceneAndRaysThatAreNoneMeetNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<glsl::ListedRay> rays{{{0, 0, 0}, 0.0f, {0, 0, 1}, 1e9f},    {{0, 0, 0}, 0.0f, {0, 0, 0}, 1e9f},
                                          {{kNan, 0, 0}, 0.0f, {0, 0, 1}, 1e9f}, {{0, 0, 0}, 0.0f, {0, kNan, 1}, 1e9f},
                                          {{0, 0, 0}, 1.0f, {0, 0, 1}, 0.5f},    {{0, 0, 0}, kNan, {0, 0, 1}, kNan}};
  for (const bool empty : {true, false}) {
    const Scene scene = empty ? make_soup({}) : make_soup({{-9, -9, 0.75f}, {9, -9, 0.75f}, {0, 9, 0.75f}});
    const SceneSnapshot snapshot = take_snapshot(scene);
    Traced traced(scene, snapshot);
    const std::vector<glsl::ListedHit> hits = trace(traced, snapshot, rays);
    for (std::size_t i = empty ? 0 : 1; i < rays.size(); ++i) EXPECT_EQ(hits[i].triangle, kMiss) << "ray " << i;
  }
}

TEST_F(BvhTest, MoreTrianglesThanTheBuilderMergesAreRefused) {
  FrameGraph graph(executor().context());
  GpuScene::Frame scene;
  scene.triangle_count = 9000000;
  EXPECT_THROW(BvhHierarchy().record(graph, scene), InputError);
}

}  // namespace
}  // namespace lightwell
