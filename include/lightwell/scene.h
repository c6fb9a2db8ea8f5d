// The scene: meshes, instances, materials, textures, lights, cameras, animations. Plain CPU data, no Vulkan.
//
// Conventions: metres, +Y up, right-handed (glTF). Colours linear, sRGB primaries. Light is radiometric SI: point and
// spot intensity W/sr, directional W/m^2, emission W/(sr m^2). Indices refer to the arrays of the same Scene; -1 means
// none. A Scene that an importer returned, or that validate() passed, holds no index out of range, no NaN.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_float3x2.hpp>
#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_uint4_sized.hpp>

#include "lightwell/image.h"

namespace lightwell {

enum class Wrap : std::uint8_t { kRepeat, kMirroredRepeat, kClampToEdge };

// width x height RGBA8 texels, row 0 at v = 0. Colour textures are sRGB encoded (alpha linear).
struct Texture {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  bool nearest = false;  // magnification and minification without interpolation
};

inline constexpr std::size_t kTexcoordSets = 4;

// A use of a texture: uv' = transform * (u, v, 1) on texture coordinate set `texcoord` (KHR_texture_transform).
struct TextureRef {
  int texture = -1;
  int texcoord = 0;  // below kTexcoordSets
  glm::mat3x2 transform{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f};
};

enum class AlphaMode : std::uint8_t { kOpaque, kMask, kBlend };

// Lambert with base colour; metallic, roughness, specular, ior, normals and heights are read and kept for later. All
// surfaces reflect and block light on both sides; emission leaves the front side only unless double_sided. kBlend is
// shown as kMask with cutoff 0.5.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0f};
  TextureRef base_color_texture;
  glm::vec3 emission{0.0f};  // W/(sr m^2)
  TextureRef emission_texture;
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  float metallic = 1.0f;
  float roughness = 1.0f;
  TextureRef metallic_roughness_texture;
  float specular = 1.0f;
  glm::vec3 specular_color{1.0f};
  float ior = 1.5f;
  TextureRef normal_texture;  // tangent space, 2 * texel - 1
  float normal_scale = 1.0f;  // of its x and y
  TextureRef bump_texture;    // height: the texel's red times bump_scale
  float bump_scale = 1.0f;    // m
};

struct MorphTarget {
  std::vector<glm::vec3> positions;  // offsets, one a vertex, or empty
  std::vector<glm::vec3> normals;
};

// Indexed triangles of one material. Every attribute array is empty or has one entry a vertex; normals are never empty
// (importers make flat ones) and are unit length.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::array<std::vector<glm::vec2>, kTexcoordSets> texcoords;
  std::vector<glm::vec4> colors;     // linear, 0 to 1: multiply the material's base colour
  std::vector<glm::u16vec4> joints;  // into Skin::joints
  std::vector<glm::vec4> weights;    // sum 1; of more influences in a file the four largest are kept
  std::vector<MorphTarget> morph_targets;
  std::vector<std::uint32_t> indices;  // 3 a triangle
  int material = -1;                   // -1: the default material (white, Lambert)
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> morph_weights;  // defaults
};

struct Node {
  std::string name;
  int parent = -1;              // always smaller than this node's own index
  glm::dvec3 translation{0.0};  // double: far from 0 much of a float is lost
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
  glm::vec3 scale{1.0f};
  std::optional<glm::dmat4> matrix;  // replaces translation, rotation, scale
  int mesh = -1;
  int skin = -1;
  int camera = -1;
  int light = -1;
  std::vector<float> morph_weights;  // replaces the mesh's
};

struct Skin {
  std::vector<int> joints;                       // nodes
  std::vector<glm::mat4> inverse_bind_matrices;  // one a joint
};

// The most intensity, irradiance or emission of any light, and the farthest that a scene may reach (m): beyond them,
// squares and sums of light and squared areas overflow single precision.
inline constexpr float kMaxLight = 1e18f;
inline constexpr float kMaxCoordinate = 1e9f;

enum class LightType : std::uint8_t { kPoint, kSpot, kDirectional };

// Shines along the node's -Z. Point and spot: E = intensity * cos / d^2, times
// max(1 - (d / range)^4, 0) where there is a range (KHR_lights_punctual).
// Spot fall-off: t^2 with t = clamp((cos - cos_outer) / (cos_inner - cos_outer), 0, 1).
struct Light {
  std::string name;
  LightType type = LightType::kPoint;
  glm::vec3 intensity{1.0f};  // W/sr, directional: W/m^2 perpendicular to the light
  float inner_angle = 0.0f;   // radians, from the axis
  float outer_angle = 0.7853982f;
  float range = std::numeric_limits<float>::infinity();  // m; nothing is lit from farther away
};

// Looks along the node's -Z with +Y up. Perspective, or orthographic if half_height is more than 0.
struct Camera {
  std::string name;
  float yfov = 0.7853982f;   // radians
  float half_height = 0.0f;  // m, of what an orthographic camera shows; yfov does not count then
  float znear = 0.01f;
  float zfar = 1000.0f;
};

// Light from outside. `map`, if any, is latitude-longitude: u = atan2(d.x, -d.z) / 2pi + 1/2, v = acos(d.y) / pi,
// multiplied by `radiance`. No map: constant.
struct Environment {
  glm::vec3 radiance{0.0f};  // W/(sr m^2)
  Image map;                 // 3 channels or width 0
};

enum class Interpolation : std::uint8_t { kStep, kLinear, kCubicSpline };
enum class AnimationPath : std::uint8_t { kTranslation, kRotation, kScale, kMorphWeights };

// Moves one property of a node. Rotations between linear keys turn evenly, the shorter way.
struct AnimationChannel {
  int node = -1;
  AnimationPath path = AnimationPath::kTranslation;
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<float> times;   // seconds, never falling; where two keys share a time the later one counts from then on
  std::vector<float> values;  // 3, 4 (x,y,z,w) or weight-count floats a key; three times that for cubic splines
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Skin> skins;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<Animation> animations;
  Environment environment;
  // Where snapshots have their origin, in the coordinates of the nodes: load_scene() chooses a point near what is far
  // from theirs, for single precision is finest about 0. All that a renderer is given or gives back is relative to it.
  glm::dvec3 origin{0.0};
};

// ---- what a renderer sees of a scene at one moment ----

// A mesh where it is now, in the pose that it has now. Skinned primitives are placed by their joints alone: the
// transform of the mesh's own node does not count (glTF 2.0, 3.7.3.3).
struct MeshInstance {
  int mesh = -1;
  int node = -1;                       // -1: none
  glm::mat4 to_world{1.0f};            // of primitives without joints
  std::vector<glm::mat4> joints;       // of primitives with joints: bind pose to world, one a joint; empty: no skin
  std::vector<float> morph_weights{};  // one a morph target; those that are missing count 0
};

struct WorldLight {
  LightType type = LightType::kPoint;
  glm::vec3 position{0.0f};
  glm::vec3 direction{0.0f, 0.0f, -1.0f};  // unit, from the light
  glm::vec3 intensity{0.0f};
  float cos_inner = 1.0f;
  float cos_outer = 0.0f;
  float range = std::numeric_limits<float>::infinity();  // m
};

struct WorldCamera {
  std::string name;
  glm::vec3 position{0.0f};
  glm::vec3 forward{0.0f, 0.0f, -1.0f};  // unit
  glm::vec3 up{0.0f, 1.0f, 0.0f};        // unit, perpendicular to forward
  float yfov = 0.7853982f;
  float half_height = 0.0f;  // m; more than 0: orthographic
  float znear = 0.01f;
  float zfar = 1000.0f;
};

struct Bounds {
  glm::vec3 minimum{0.0f};
  glm::vec3 maximum{0.0f};
};

// Relative to Scene::origin, all of it.
struct SceneSnapshot {
  std::vector<MeshInstance> instances;
  std::vector<WorldLight> lights;
  std::vector<WorldCamera> cameras;
  Bounds bounds;  // of all vertices in the world; infinite if one of them is not finite
};

// The scene with its nodes at rest, which is how the file gives them; instances, lights and cameras in node order.
SceneSnapshot take_snapshot(const Scene& scene);

// The same with `nodes` in place of the scene's, as many and in the same tree: what animate_nodes() returns.
SceneSnapshot take_snapshot(const Scene& scene, const std::vector<Node>& nodes);

// Time of the animation's last key, in seconds; 0 without channels.
float animation_end(const Animation& animation);

// The scene's nodes as the animation has them at `seconds`; those that it does not move are at rest. Before the first
// key of a channel its first value holds, after its last the last (glTF 2.0, 3.11); to loop, pass the time modulo
// animation_end(). `animation` must have passed validate() as a part of `scene`.
std::vector<Node> animate_nodes(const Scene& scene, const Animation& animation, float seconds);

// A view of the whole scene for files without a camera: from the front and a little above, field of view 45 degrees.
WorldCamera default_camera(const Bounds& bounds);

// ---- files ----

struct ImportOptions {
  float scale = 1.0f;  // file unit in metres
  char up = 'y';       // 'y' or 'z': the file's up axis, turned to +Y
  // Scene files name others: buffers, images, MTL libraries and their maps. With a folder here all that is read, `path`
  // included, must lie in it once symbolic links are resolved; else load_scene() throws. Empty, the default: any
  // regular file may be read, as honest scenes share "../textures". Set it for scenes that strangers send; the folder
  // must not change meanwhile.
  std::string root;
};

// Origin for a scene that covers `bounds`: 0, unless their centre is farther off than 512 m and 16 times their half
// diagonal; then that centre, in whole metres.
glm::dvec3 choose_origin(const Bounds& bounds);

// Loads a .gltf, .glb, .obj or .ply file. What can be shown is shown, with one warning in the log for each thing that
// is left out or changed: it names the file, the place and what was done. Throws InputError naming the file and what is
// wrong with it where nothing is left to show, or where what is left cannot be trusted.
Scene load_scene(const std::string& path, const ImportOptions& options = {});

// Throws InputError naming `subject` if an index is out of range, an array has the wrong length or a number is not
// finite.
void validate(const Scene& scene, const std::string& subject);

// The same for what moving a valid scene's nodes can do: carry something farther than kMaxCoordinate, or to no place at
// all.
void validate(const SceneSnapshot& snapshot, const std::string& subject);

}  // namespace lightwell
