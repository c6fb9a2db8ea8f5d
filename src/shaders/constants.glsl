// Numbers that never change. Only words that GLSL and C++ share: tests compile sh.glsl, which includes this, as C++.
#ifndef LIGHTWELL_CONSTANTS_GLSL
#define LIGHTWELL_CONSTANTS_GLSL

const float kPi = 3.14159265358979f;

#endif
