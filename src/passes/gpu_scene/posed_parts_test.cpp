#include "passes/gpu_scene/posed_parts.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "scene/pose.h"

namespace lightwell {
namespace {

// A rigid, a skinned and a morphed part of one mesh; each of two instances.
const std::vector<FlatPart> kParts{
    {.shape = {}, .instance = 0, .vertex_count = 5},
    {.shape = {.joint_count = 2}, .instance = 0, .vertex_count = 5},
    {.shape = {.first_morph_offset = 100, .morph_target_count = 3}, .instance = 0, .vertex_count = 5},
    {.shape = {}, .instance = 1, .vertex_count = 5},
    {.shape = {.joint_count = 2}, .instance = 1, .vertex_count = 5},
    {.shape = {.first_morph_offset = 100, .morph_target_count = 3}, .instance = 1, .vertex_count = 5}};

glm::mat4 shift(float x) {
  return glm::translate(glm::mat4(1), glm::vec3(x, 0, 0));
}

TEST(PosedParts, EachInstanceBringsItsOwnJointsAndWeights) {
  const PosedParts posed = pose_parts(kParts, {{0, -1, shift(9), {shift(1), shift(2)}, {0.5f, 0.0f, 0.25f}},
                                               {0, -1, shift(8), {shift(3), shift(4), shift(5)}, {0.0f, 2.0f}}});
  ASSERT_EQ(posed.joints.size(), 5u);
  EXPECT_EQ(posed.parts[0].row_0, glm::vec4(1, 0, 0, 9));
  EXPECT_EQ(posed.parts[0].skin_count, 0u);
  EXPECT_EQ(posed.parts[1].skin_count, 1u);
  EXPECT_EQ(posed.joints[posed.parts[1].first_joint].row_0.w, 1.0f);
  EXPECT_EQ(posed.joints[posed.parts[4].first_joint + 1].row_0.w, 4.0f);
  ASSERT_EQ(posed.morphs.size(), 3u);
  EXPECT_EQ(posed.parts[2].morph_count, 2u);
  EXPECT_EQ(posed.morphs[posed.parts[2].first_morph + 1].first_offset, 100u + 2 * 5);
  EXPECT_EQ(posed.parts[5].morph_count, 1u);
  EXPECT_EQ(posed.morphs[posed.parts[5].first_morph].first_offset, 100u + 5);
  EXPECT_EQ(posed.morphs[posed.parts[5].first_morph].weight, 2.0f);
}

TEST(PosedParts, WithoutASkinTheNodePlacesAll) {
  const PosedParts posed = pose_parts(kParts, {{0, -1, shift(9)}, {0, -1, shift(8)}});
  EXPECT_TRUE(posed.joints.empty());
  EXPECT_TRUE(posed.morphs.empty());
  for (const glsl::Part& part : posed.parts) EXPECT_EQ(part.skin_count + part.morph_count, 0u);
}

TEST(PosedParts, MirrorsAreThoseOfTheScenesPose) {
  Primitive rigid;
  Primitive skinned;
  skinned.joints.resize(1);
  const glm::mat4 mirror = glm::scale(glm::mat4(1), glm::vec3(1, 1, -1));
  for (const glm::mat4& node : {glm::mat4(1), mirror}) {
    for (const glm::mat4& joint : {glm::mat4(1), mirror}) {
      const MeshInstance instance{0, -1, node, {joint, glm::mat4(1)}};
      const PosedParts posed = pose_parts({kParts[0], kParts[1]}, {instance});
      EXPECT_EQ(posed.parts[0].handedness < 0.0f, is_mirrored(rigid, instance));
      EXPECT_EQ(posed.parts[1].handedness < 0.0f, is_mirrored(skinned, instance));
    }
  }
}

}  // namespace
}  // namespace lightwell
