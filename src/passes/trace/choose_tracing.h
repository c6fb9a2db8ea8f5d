// Which way of tracing is the faster one here.
#pragma once

#include "passes/trace/tracer.h"

namespace lightwell {

// Our own hierarchy on devices without ray queries. On the others both trace a few thousand rays through a made-up
// scene, once a device, and ray queries must be clearly faster: what wins by a hair would change from run to run, and
// with it the last bits of a picture. Only the host submits to a device that it lent, so there the kind of device
// decides: ray queries unless it is a software one.
Tracing choose_tracing(Device& device);

}  // namespace lightwell
