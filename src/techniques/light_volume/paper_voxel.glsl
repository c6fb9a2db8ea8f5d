// What a voxel holds while three slicings are combined with MAX: six planes of non-negative floats as bit patterns,
// which order like the floats themselves, so that atomicMax on integers is the blending MAX of the source.
#ifndef LIGHTWELL_LIGHT_VOLUME_PAPER_VOXEL_GLSL
#define LIGHTWELL_LIGHT_VOLUME_PAPER_VOXEL_GLSL

const uint kPaperNormalPlane = 0;
const uint kPaperRadiancePlane = 3;

// MAX works on each component by itself: where several surfaces meet in a cell the result leans to the positive axes,
// and may even cancel to zero. As published.
vec3 paper_encode_normal(vec3 normal) { return normal * 0.5 + 0.5; }

// An empty cell holds 0 everywhere. The largest component of a unit vector is at least -1/sqrt(3), so the largest of its
// code at least 0.2: occupancy needs no plane of its own.
bool paper_is_occupied(vec3 code) { return max(code.x, max(code.y, code.z)) > 0.0; }

// Unit, or zero where opposite surfaces have cancelled: a hemisphere about zero is half its radiance in all directions.
vec3 paper_decode_normal(vec3 code) {
  vec3 normal = code * 2.0 - 1.0;
  float size = length(normal);
  return size > 1e-3 ? normal / size : vec3(0.0);
}

#endif
