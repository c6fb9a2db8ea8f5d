// Camera-side injection: rays against the scene's triangles.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "techniques/ray_traced_voxels/paper_types.h"

layout(local_size_x = 64) in;
LW_PUSH_CONSTANTS(VoxelInjectParams, LW_VOXEL_INJECT_PARAMS)

#include "shaders/trace.glsl"

#include "shaders/camera.h"
#include "shaders/lights.h"

layout(set = 0, binding = 0) readonly buffer LightBuffer { GpuLight data[]; } lights;
layout(set = 0, binding = 1) readonly buffer AlbedoBuffer { uint data[]; } albedo;
layout(set = 0, binding = 2) readonly buffer NormalBuffer { uint data[]; } normals;
layout(set = 0, binding = 3) writeonly buffer HitBuffer { VoxelHit data[]; } hits;
layout(set = 0, binding = 4) uniform Camera { LW_GPU_CAMERA(LW_DECLARE_MEMBER) } camera;

#include "techniques/ray_traced_voxels/paper_inject.glsl"

#include "techniques/ray_traced_voxels/paper_find_triangle.glsl"

#include "techniques/ray_traced_voxels/paper_inject_camera.glsl"
