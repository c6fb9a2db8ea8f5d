// Pictures that a machine cannot hold are refused before work on them begins.
#pragma once

#include <glm/ext/vector_int2.hpp>

namespace lightwell {

class Device;

// Throws InputError naming --size if the picture alone, with its parts, does not fit into this process's memory.
void check_picture_memory(const glm::ivec2& size);

// The same for a picture of the photon mapper and what it keeps of each pixel beside it.
void check_photon_mapper_memory(const glm::ivec2& size);

// The same for all that a frame takes, where the device has no memory of its own.
void check_frame_memory(const glm::ivec2& size, const Device& device);

}  // namespace lightwell
