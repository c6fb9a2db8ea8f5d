// Lights and environment from the command line. All angles in degrees, all quantities radiometric SI.
#pragma once

#include <string>

#include "lightwell/scene.h"

namespace lightwell {

// Adds the light that `spec` describes (--light), as a node at the end of the scene:
//   "point pos=x,y,z intensity=r,g,b"                                     W/sr; one number means grey
//   "spot  pos=x,y,z dir=x,y,z intensity=r,g,b [inner=deg] [outer=deg]"   angles from the axis, 0 and 45 if not given
//   "sun   dir=x,y,z irradiance=r,g,b"                                    W/m^2 perpendicular to the light
// `dir` is the way the light goes, away from its source: a sun overhead has dir=0,-1,0.
// Throws InputError naming --light.
void add_light(Scene& scene, const std::string& spec);

// Adds a sun described in short (--sun): "x,y,z irradiance", with the direction as above. Throws InputError.
void add_sun(Scene& scene, const std::string& spec);

// Removes the lights that came with the scene; emissive materials and the environment stay.
void remove_lights(Scene& scene);

// Environment (--env): "r,g,b" or one number, W/(sr m^2), or the name of an .hdr or .exr file in latitude-longitude
// form. Throws InputError.
Environment parse_environment(const std::string& spec);

}  // namespace lightwell
