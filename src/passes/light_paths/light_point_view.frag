// A disc.
#version 460

layout(location = 0) in vec2 in_place;
layout(location = 1) flat in vec3 in_color;

layout(location = 0) out vec4 picture;

void main() {
  if (dot(in_place, in_place) > 1.0) discard;
  picture = vec4(in_color, 1.0);
}
