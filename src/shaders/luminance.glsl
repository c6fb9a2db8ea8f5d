// How bright a colour looks: linear sRGB primaries (ITU-R BT.709).
#ifndef LIGHTWELL_LUMINANCE_GLSL
#define LIGHTWELL_LUMINANCE_GLSL

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

#endif
