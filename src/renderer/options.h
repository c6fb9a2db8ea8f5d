// From RendererOptions to what they name.
#pragma once

#include <memory>

#include "lightwell/renderer.h"
#include "passes/trace/tracer.h"
#include "techniques/technique.h"

namespace lightwell {

// The technique with its preset and options, or null for "none". Throws InputError listing what there is.
std::unique_ptr<Technique> create_technique(const RendererOptions& options);

// Throws InputError where a number is out of its range, or the size more than `largest_side` pixels.
void check_options(const RendererOptions& options, std::uint32_t largest_side);

// What RendererOptions::tracing means on this device; measures where it says auto, `is_needed` (something will trace)
// and nobody has yet. Throws InputError for ray queries on a device that has none.
Tracing resolve_tracing(Device& device, int option, bool is_needed);

}  // namespace lightwell
