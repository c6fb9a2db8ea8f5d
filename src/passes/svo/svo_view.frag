// Edges of boxes, a pixel to either side; faces of leaves hide what is behind them.
#version 460

layout(location = 0) in vec2 place;
layout(location = 1) flat in uint leaf;
layout(location = 2) flat in uint axis;
layout(location = 0) out vec4 color;

void main() {
  vec2 pixels = min(place, 1.0 - place) / max(fwidth(place), vec2(1e-6));
  bool edge = min(pixels.x, pixels.y) < 1.0;
  if (!edge && leaf == 0) discard;
  vec3 line = leaf != 0 ? vec3(0.05, 0.1, 1.0) : vec3(0.0, 0.8, 0.1);
  // A shade for each axis.
  vec3 face = vec3(0.02, 0.03, 0.1) * (1.0 + 0.7 * float(axis));
  color = vec4(edge ? line : face, 1.0);
}
