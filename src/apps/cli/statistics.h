// What a render cost, as text or JSON.
#pragma once

#include <string>

#include "lightwell/photon_mapper.h"
#include "lightwell/renderer.h"

namespace lightwell {

// The members of RenderStatistics under their own names, and "device".
std::string statistics_as_json(const RenderStatistics& statistics, const std::string& device);

// A table for people.
std::string statistics_as_text(const RenderStatistics& statistics, const std::string& device);

// The members of PhotonMapperStatistics under their own names, and "bytes_per_photon", tree included.
std::string statistics_as_json(const PhotonMapperStatistics& statistics);
std::string statistics_as_text(const PhotonMapperStatistics& statistics);

}  // namespace lightwell
