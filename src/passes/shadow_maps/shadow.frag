// Depth only.
#version 460

void main() {}
