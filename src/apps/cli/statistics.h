// What a render cost, as text or JSON.
#pragma once

#include <string>

#include "lightwell/renderer.h"

namespace lightwell {

// The members of RenderStatistics under their own names, and "device".
std::string statistics_as_json(const RenderStatistics& statistics, const std::string& device);

// A table for people.
std::string statistics_as_text(const RenderStatistics& statistics, const std::string& device);

}  // namespace lightwell
