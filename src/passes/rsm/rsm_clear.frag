// Texels that see nothing.
#version 460

layout(location = 0) out vec4 position;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec4 flux;

void main() {
  position = vec4(0.0);
  normal = vec4(0.0);
  flux = vec4(0.0);
}
