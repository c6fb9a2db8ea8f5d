#include "scene/ply_contents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightwell/metrics.h"
#include "scene/geometry.h"

namespace lightwell {

namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

using Names = std::array<std::string_view, 4>;

// Which number each scalar property is, by `names`; the last place takes what is not needed.
template <std::size_t kCount>
struct Places {
  Places(const PlyElement& element, const std::array<Names, kCount>& names) {
    for (const PlyProperty& property : element.properties) {
      std::size_t place = 0;
      while (place < kCount &&
             (property.is_list || property.name.empty() ||
              std::find(names[place].begin(), names[place].end(), property.name) == names[place].end()))
        ++place;
      of_property.push_back(place);
      present[place] = true;
      if (property.type != PlyScalar::kFloat && property.type != PlyScalar::kDouble) is_integer[place] = true;
      if (property.type == PlyScalar::kUint16 || property.type == PlyScalar::kInt16) is_wide[place] = true;
    }
  }
  bool has(std::size_t first, std::size_t count) const {
    return std::all_of(present.begin() + static_cast<std::ptrdiff_t>(first),
                       present.begin() + static_cast<std::ptrdiff_t>(first + count), [](bool there) { return there; });
  }
  // The number that stands for the whole of a colour.
  float whole(std::size_t place) const { return !is_integer[place] ? 1.0f : is_wide[place] ? 65535.0f : 255.0f; }

  std::vector<std::size_t> of_property;
  std::array<bool, kCount + 1> present{};
  std::array<bool, kCount + 1> is_integer{};
  std::array<bool, kCount + 1> is_wide{};
};

constexpr Names kRed = {"red", "diffuse_red"}, kGreen = {"green", "diffuse_green"}, kBlue = {"blue", "diffuse_blue"},
                kAlpha = {"alpha", "diffuse_alpha"};

// Programs write what their screens show: sRGB. Alpha is linear.
template <std::size_t kCount>
glm::vec4 color_of(const Places<kCount>& places, const std::array<float, kCount + 1>& values, std::size_t first) {
  glm::vec4 color(1.0f);
  for (std::size_t c = 0; c < 3; ++c)
    color[static_cast<int>(c)] = srgb_decode(std::clamp(values[first + c] / places.whole(first + c), 0.0f, 1.0f));
  if (places.present[first + 3]) color.a = std::clamp(values[first + 3] / places.whole(first + 3), 0.0f, 1.0f);
  for (int c = 0; c < 4; ++c)
    if (std::isnan(color[c])) color[c] = 1.0f;
  return color;
}

class PlyElements {
 public:
  PlyElements(PlyFile& file, FileNotes& notes) : file_(file), notes_(notes) {}
  PlyContents read();

 private:
  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element);
  void read_strips(const PlyElement& element);
  std::uint32_t take_index(const PlyProperty& property);
  void list_unread(const PlyElement& element, const std::vector<std::string_view>& read);

  PlyFile& file_;
  FileNotes& notes_;
  PlyContents contents_;
};

bool is_indices(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void PlyElements::list_unread(const PlyElement& element, const std::vector<std::string_view>& read) {
  std::string names;
  for (const PlyProperty& property : element.properties)
    if (std::find(read.begin(), read.end(), property.name) == read.end() && names.size() < 200)
      names.append(names.empty() ? "" : ", ").append(property.name.substr(0, 40));
  if (!names.empty()) notes_.add("element '" + element.name.substr(0, 40) + "'", "not shown: " + names);
}

void PlyElements::read_vertices(const PlyElement& element) {
  constexpr std::size_t kCount = 12, kNormal = 3, kTexcoord = 6, kColor = 8;
  constexpr std::array<Names, kCount> kNames = {{{"x"},
                                                 {"y"},
                                                 {"z"},
                                                 {"nx"},
                                                 {"ny"},
                                                 {"nz"},
                                                 {"u", "s", "texture_u", "texcoord_u"},
                                                 {"v", "t", "texture_v", "texcoord_v"},
                                                 kRed,
                                                 kGreen,
                                                 kBlue,
                                                 kAlpha}};
  const Places<kCount> places(element, kNames);
  std::vector<std::string_view> read;
  for (std::size_t p = 0; p < places.of_property.size(); ++p)
    if (places.of_property[p] < kCount) read.push_back(element.properties[p].name);
  list_unread(element, read);
  if (!places.has(0, 3)) file_.fail("vertices have no x, y, z");
  const bool has_normals = places.has(kNormal, 3), has_texcoords = places.has(kTexcoord, 2);
  const bool has_colors = places.has(kColor, 3);

  std::array<float, kCount + 1> v{};
  std::array<double, kCount + 1> exact{};
  std::vector<glm::dvec3> positions;
  FarVertices far;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < places.of_property.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      for (std::uint64_t n = file_.take_size(property); n > 0; --n)
        exact[places.of_property[p]] = file_.scalar(property.type);
    }
    std::transform(exact.begin(), exact.end(), v.begin(), [](double x) { return static_cast<float>(x); });
    const std::string place = "vertex " + std::to_string(i);
    positions.emplace_back(exact[0], exact[1], exact[2]);
    far.add(positions.back());
    if (has_normals) {
      glm::vec3 normal(v[kNormal], v[kNormal + 1], v[kNormal + 2]);
      if (!is_finite(normal)) {
        notes_.add(place, "a normal that is no number: made from its faces");
        normal = glm::vec3(0.0f);
      }
      contents_.vertices.normals.push_back(normal);
    }
    if (has_texcoords) {
      glm::vec2 uv(v[kTexcoord], 1.0f - v[kTexcoord + 1]);  // v points up in PLY
      if (!is_finite(glm::vec3(uv, 0.0f))) {
        notes_.add(place, "a texture coordinate that is no number: taken as 0");
        uv = glm::vec2(0.0f);
      }
      contents_.vertices.texcoords[0].push_back(uv);
    }
    if (has_colors) contents_.vertices.colors.push_back(color_of(places, v, kColor));
    contents_.lets_light_through =
        contents_.lets_light_through || (has_colors && contents_.vertices.colors.back().a < 1.0f);
  }
  contents_.base = far.base();
  contents_.vertices.positions.reserve(positions.size());
  for (const glm::dvec3& position : positions) contents_.vertices.positions.emplace_back(position - contents_.base);
}

std::uint32_t PlyElements::take_index(const PlyProperty& property) {
  const double index = file_.scalar(property.type);
  const bool possible = index >= 0.0 && index < kNoPlyVertex && index == std::floor(index);
  return possible ? static_cast<std::uint32_t>(index) : kNoPlyVertex;
}

void PlyElements::read_faces(const PlyElement& element) {
  constexpr std::size_t kCount = 5, kColor = 0, kTexture = 4;
  constexpr std::array<Names, kCount> kNames = {{kRed, kGreen, kBlue, kAlpha, {"texnumber"}}};
  const Places<kCount> places(element, kNames);
  const auto is_texcoords = [](const PlyProperty& property) { return property.is_list && property.name == "texcoord"; };
  std::vector<std::string_view> read;
  bool has_texcoords = false;
  for (std::size_t p = 0; p < places.of_property.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    has_texcoords = has_texcoords || is_texcoords(property);
    if (places.of_property[p] < kCount || is_indices(property) || is_texcoords(property)) read.push_back(property.name);
  }
  list_unread(element, read);
  const bool has_colors = places.has(kColor, 3), has_textures = places.present[kTexture];

  std::array<float, kCount + 1> values{};
  std::vector<float> texcoords;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    const std::size_t first = contents_.polygons.corners.size();
    texcoords.clear();
    for (std::size_t p = 0; p < places.of_property.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      for (std::uint64_t n = file_.take_size(property); n > 0; --n) {
        if (is_indices(property))
          contents_.polygons.corners.push_back(take_index(property));
        else if (is_texcoords(property))
          texcoords.push_back(static_cast<float>(file_.scalar(property.type)));
        else
          values[places.of_property[p]] = static_cast<float>(file_.scalar(property.type));
      }
    }
    const std::size_t size = contents_.polygons.corners.size() - first;
    contents_.polygons.sizes.push_back(static_cast<std::uint32_t>(size));
    if (has_texcoords) {
      constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
      const bool complete = texcoords.size() == 2 * size;
      if (!complete && !texcoords.empty())
        notes_.add("face " + std::to_string(i), "not two texture coordinates a corner: left out");
      for (std::size_t k = 0; k < size; ++k) {
        const glm::vec2 uv = complete ? glm::vec2(texcoords[2 * k], 1.0f - texcoords[2 * k + 1]) : glm::vec2(kNone);
        contents_.polygons.texcoords.push_back(is_finite(glm::vec3(uv, 0.0f)) ? uv : glm::vec2(kNone));
      }
    }
    if (has_colors) contents_.polygons.colors.push_back(color_of(places, values, kColor));
    contents_.lets_light_through =
        contents_.lets_light_through || (has_colors && contents_.polygons.colors.back().a < 1.0f);
    if (has_textures) {
      const float number = values[kTexture];
      const bool known = number >= 0.0f && number < static_cast<float>(file_.texture_files().size());
      if (!known) notes_.add("face " + std::to_string(i), "a texture number that is none of the file's: left out");
      contents_.polygons.textures.push_back(known ? static_cast<int>(number) : -1);
    }
  }
}

// Lists of any length; -1 ends a strip and begins another.
void PlyElements::read_strips(const PlyElement& element) {
  std::vector<std::uint32_t> strip;
  const auto finish = [&] {
    const std::vector<std::uint32_t> triangles = triangles_of_strip(strip);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
      // Strips are joined by triangles without area.
      if (triangles[i] == triangles[i + 1] || triangles[i + 1] == triangles[i + 2] || triangles[i] == triangles[i + 2])
        continue;
      contents_.polygons.sizes.push_back(3);
      contents_.polygons.corners.insert(contents_.polygons.corners.end(),
                                        {triangles[i], triangles[i + 1], triangles[i + 2]});
    }
    strip.clear();
  };
  list_unread(element, {"vertex_indices", "vertex_index"});
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      for (std::uint64_t n = file_.take_size(property); n > 0; --n) {
        const std::uint32_t index = take_index(property);
        if (!is_indices(property)) continue;
        if (index == kNoPlyVertex)
          finish();
        else
          strip.push_back(index);
      }
      finish();
    }
}

PlyContents PlyElements::read() {
  for (const PlyElement& element : file_.elements()) {
    file_.check_count(element);
    if (element.name == "vertex" && contents_.vertices.positions.empty()) {
      read_vertices(element);
    } else if (element.name == "face") {
      read_faces(element);
    } else if (element.name == "tristrips") {
      read_strips(element);
    } else {
      if (element.count > 0) notes_.add("element '" + element.name.substr(0, 40) + "'", "is not shown");
      file_.skip(element);
    }
  }
  return std::move(contents_);
}

}  // namespace

PlyContents read_ply_contents(PlyFile& file, FileNotes& notes) {
  return PlyElements(file, notes).read();
}

}  // namespace lightwell
