// The same rays through the voxels: the first that is occupied ends a ray (section 3.3.3.2). A ray does not meet the
// voxel that it starts in. After paper_inject.glsl.
#ifndef LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FIND_VOXEL_GLSL
#define LIGHTWELL_RAY_TRACED_VOXELS_PAPER_FIND_VOXEL_GLSL

// Walks from voxel to voxel (Amanatides and Woo 1987) up to `most` metres.
Found march(vec3 origin, vec3 direction, float most) {
  float low = -kPublishedOffset;
  float high = float(params.grid.resolution.x) - kPublishedOffset;
  vec3 from = stored_place(params.grid, origin);
  vec3 steps = mix(vec3(1.0), vec3(-1.0), lessThan(direction, vec3(0.0)));
  vec3 inverse = steps / max(abs(direction), vec3(1e-9));
  vec3 to_low = (low - from) * inverse;
  vec3 to_high = (high - from) * inverse;
  vec3 enters = min(to_low, to_high);
  vec3 leaves = max(to_low, to_high);
  float t = max(max(max(enters.x, enters.y), enters.z), 0.0);
  float last = min(min(min(leaves.x, leaves.y), leaves.z), most / params.grid.cell_size);
  vec3 cell = clamp(floor(from + t * direction), vec3(low), vec3(high - 1.0));
  uint own = voxel_of(params.grid, origin);
  uint bound = 3 * (params.grid.resolution.x + 2);
  Found found = Found(-1.0, kNoVoxel, vec3(0.0));
  bool going = t < last;
  for (uint i = 0; i < bound && going; ++i) {
    uint voxel = grid_cell_index(params.grid, ivec3(max(cell, vec3(0.0))));
    vec3 exits = (cell + max(steps, vec3(0.0)) - from) * inverse;
    float exit = min(min(exits.x, exits.y), exits.z);
    if (voxel != own && is_occupied(albedo.data[voxel])) {
      // In the middle of its way through the voxel.
      found.t = 0.5 * (t + max(exit, t)) * params.grid.cell_size;
      found.voxel = voxel;
    }
    cell += mix(vec3(0.0), steps, equal(exits, vec3(exit)));
    t = max(t, exit);
    bool inside = all(greaterThanEqual(cell, vec3(low))) && all(lessThan(cell, vec3(high)));
    going = found.voxel == kNoVoxel && inside && t < last;
  }
  found.start = origin + max(found.t, 0.0) * direction;
  return found;
}

Found find_surface(vec3 origin, float least, vec3 direction) { return march(origin, direction, 1e30); }

bool is_dark(vec3 start, vec3 direction, float most) {
  float size = length(direction);
  return march(start, direction / size, most * size).voxel != kNoVoxel;
}

#endif
