// From RendererOptions to what they name.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lightwell/renderer.h"
#include "passes/trace/tracer.h"
#include "techniques/technique.h"

namespace lightwell {

// The technique with its preset and options, or null for "none". Throws InputError listing what there is.
std::unique_ptr<Technique> create_technique(const RendererOptions& options);

// Throws InputError where a number is out of its range, or the size more than `largest_side` pixels.
void check_options(const RendererOptions& options, std::uint32_t largest_side);

// Whom RendererOptions::tracing names; none: the faster one. Throws InputError for ray queries on a device that has
// none.
std::optional<Tracing> fixed_tracing(const Device& device, int option);

// What decides the technique's world part: views of equal keys share it.
std::string world_key(const RendererOptions& options, Technique& technique, LightKinds covered);

}  // namespace lightwell
