// All functions of voxel_levels_types.h, for a test to compare.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/voxel_grid/testing/level_functions.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer QuestionBuffer { LevelQuestion data[]; } questions;
layout(set = 0, binding = 1) writeonly buffer AnswerBuffer { LevelAnswer data[]; } answers;

#include "shaders/linear_dispatch.glsl"

void main() {
  uint i = linear_invocation();
  if (i >= params.count) return;
  LevelQuestion question = questions.data[i];
  VoxelLevels levels = question.levels;
  uint level = level_of_index(levels, question.index);
  VoxelGrid grid = level_grid(levels, level);
  ivec3 cell = level_cell_at(levels, question.index);
  answers.data[i] =
      LevelAnswer(level_lower(levels, level), level, grid.origin, grid.cell_size, cell,
                  level_cell_index(levels, level, cell), level_weight(levels, level, question.position),
                  is_same_cell(levels, question.old_center, question.index) ? 1 : 0,
                  level_at(levels, question.position, question.footprint), 0);
}
