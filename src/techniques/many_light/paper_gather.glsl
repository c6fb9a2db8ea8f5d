// Indirect light by the part of the light points that a tile sees (Sun and Agu 2015, Sec. 4.10). The including kernel
// has bindings 0 to 3 of set 0 for itself and defines
//   bool is_occluded(Receiver receiver, LightPoint point);
#ifndef LIGHTWELL_PAPER_GATHER_GLSL
#define LIGHTWELL_PAPER_GATHER_GLSL

LW_PUSH_CONSTANTS(PaperGatherParams, LW_PAPER_GATHER_PARAMS)
layout(set = 0, binding = 4) uniform sampler2D split_position;
layout(set = 0, binding = 5) uniform sampler2D split_normal;
layout(set = 0, binding = 6) uniform sampler2D split_face;
layout(set = 0, binding = 7) readonly buffer PointBuffer { LightPoint data[]; } points;
layout(set = 0, binding = 8, rgba32f) writeonly uniform image2D split_light;

void main() {
  uvec2 place = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(place, kSplit * params.tile_size))) return;
  vec4 here = texelFetch(split_position, ivec2(place), 0);
  Receiver receiver = make_receiver(here, texelFetch(split_normal, ivec2(place), 0).xyz,
                                    from_octahedron(texelFetch(split_face, ivec2(place), 0).xy), params.clearance);
  const uint kParts = kSplit * kSplit;
  uvec2 tile = place / params.tile_size;
  uint block = params.paths / kParts;
  uint first = (tile.y * kSplit + tile.x) * block;
  vec3 sum = vec3(0.0);
  for (uint i = 0; i < (here.w > 0.0 ? block * params.bounces : 0); ++i) {
    LightPoint point = points.data[(i / block) * params.paths + first + i % block];
    float geometry = clamped_geometry(here.xyz, receiver.normal, point, params.least_distance_squared);
    if (luminance(point.flux) <= params.least_flux || geometry <= 0.0) continue;
    sum += is_occluded(receiver, point) ? vec3(0.0) : light_point_irradiance(point, geometry);
  }
  imageStore(split_light, ivec2(place), vec4(float(kParts) * sum, 1.0));
}

#endif
