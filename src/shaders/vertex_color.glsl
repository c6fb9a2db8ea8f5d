// Whether vertices have colours: in every stage that hands them on. The scene's set says so.
#ifndef LIGHTWELL_VERTEX_COLOR_GLSL
#define LIGHTWELL_VERTEX_COLOR_GLSL

// 1: some do; 0 spares the device the code.
layout(constant_id = 15) const uint kVertexColors = 1;

#endif
