// What is in the elements of a PLY file: vertices with positions, optional normals, texture coordinates and colours;
// faces as lists of any integer type, with texture coordinates, texture numbers and colours of their own; triangle
// strips. What else there is is left out with a note.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lightwell/scene.h"
#include "scene/file_notes.h"
#include "scene/ply_file.h"

namespace lightwell {

inline constexpr std::uint32_t kNoPlyVertex = std::numeric_limits<std::uint32_t>::max();

// Faces and the triangles of strips as the file has them.
struct PlyPolygons {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint32_t> corners;  // kNoPlyVertex: an index that cannot be one
  std::vector<glm::vec2> texcoords;    // one a corner, NaN where its face has none; or empty
  std::vector<glm::vec4> colors;       // one a polygon, or none
  std::vector<int> textures;           // one a polygon, or none
};

struct PlyContents {
  glm::dvec3 base{0.0};  // FarVertices
  Primitive vertices;    // all of the file, less `base`; no indices
  PlyPolygons polygons;
  bool lets_light_through = false;  // some colour has an alpha below 1
};

// Reads all elements. Throws InputError where the file is cut off or its vertices have no positions.
PlyContents read_ply_contents(PlyFile& file, FileNotes& notes);

}  // namespace lightwell
