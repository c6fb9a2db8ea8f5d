// Levels of the grid and their windows. The including kernel declares `params` and `windows`, an ivec4 a level. Of one
// grid nothing of that is compiled.
#ifndef LIGHTWELL_SVO_WINDOWS_GLSL
#define LIGHTWELL_SVO_WINDOWS_GLSL

layout(constant_id = 14) const uint kSeveralLevels = 0;  // 1: more than one

// Whether a cell lies in the next finer level's window, which has the cells of that place. All from the lower corner of
// the level's window, in cells 2^shift times as large as the level's.
bool in_finer_window(uint level, uvec3 cell, uint shift) {
  if (kSeveralLevels == 0 || level == 0) return false;
  ivec3 low = (windows.data[level - 1].xyz >> 1) - windows.data[level].xyz;
  uvec3 inside = cell - uvec3(low >> int(shift));
  return all(lessThan(inside, uvec3(1u << (params.level - 1 - shift))));
}

// First word of a level's bits.
uint first_word(uint level) { return kSeveralLevels != 0 ? level * (2u << (3 * (params.level - 2))) : 0; }

// An entry of the list: a cell of a level, or of larger ones, and which level.
uint pack_entry(uint level, uvec3 cell) {
  uint bits = params.level;
  return cell.x | (cell.y << bits) | (cell.z << (2 * bits)) | (kSeveralLevels != 0 ? level << (3 * bits) : 0);
}
uint level_of_entry(uint entry) { return kSeveralLevels != 0 ? entry >> (3 * params.level) : 0; }
uvec3 cell_of_entry(uint entry) {
  uint bits = params.level;
  return (uvec3(entry) >> uvec3(0, bits, 2 * bits)) & ((1u << bits) - 1u);
}

#endif
