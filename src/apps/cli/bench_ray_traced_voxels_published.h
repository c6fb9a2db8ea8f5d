// Times that Magalhaes 2020 published for ray-traced voxels, on an RTX 2070 Super.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace lightwell {

// Milliseconds to voxelise, to inject light, and of the final pass, which draws the scene.
using VoxelTimes = std::array<double, 3>;

// The values that its tables go over.
constexpr std::array<std::string_view, 2> kPublishedScenes = {"sibenik", "sponza"};
constexpr std::array<std::string_view, 2> kPublishedLights = {"far", "near"};
constexpr std::array<std::string_view, 3> kPublishedSizes = {"640x480", "1280x720", "1920x1080"};
constexpr std::array<int, 3> kPublishedGrids = {64, 128, 256};         // voxels along a side
constexpr std::array<int, 4> kPublishedRays = {256, 512, 1024, 2048};  // rays along a side
constexpr std::array<int, 2> kPublishedTaps = {1, 7};

// By the names of the tables; each empty where a value is none of the published ones.
std::optional<VoxelTimes> published_scene(std::string_view scene);                      // 5.1
std::optional<VoxelTimes> published_output(std::string_view size, int grid, int rays);  // 7.1
std::optional<VoxelTimes> published_taps(int taps, std::string_view size, int grid);    // 7.7
std::optional<VoxelTimes> published_writes(std::string_view table, std::string_view light, int grid,
                                           int rays);  // 7.2 to 7.6

}  // namespace lightwell
