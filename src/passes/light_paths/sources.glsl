// Where a light path begins: sources are the lights, then all emitters as one, then the environment. Kernels declare
//   layout(set = 0, binding = n) readonly buffer SourceBuffer { float data[]; } sources;   // running sums of power
// before including this file.
#ifndef LIGHTWELL_LIGHT_PATHS_SOURCES_GLSL
#define LIGHTWELL_LIGHT_PATHS_SOURCES_GLSL

const uint kNoSource = 0xffffffffu;

struct SourceChoice {
  uint source;        // or kNoSource
  float place;        // of the number in the source's strip, 0 to 1
  float probability;
};

// In proportion to power.
SourceChoice choose_source(float u) {
  uint last = params.light_count + 1;
  float all = sources.data[last];
  float target = u * all;
  uint low = 0;
  uint high = last;
  for (int i = 0; i < 32 && low < high; ++i) {
    uint middle = (low + high) / 2;
    if (sources.data[middle] > target) high = middle;
    else low = middle + 1;
  }
  float below = low > 0 ? sources.data[low - 1] : 0.0;
  float own = sources.data[low] - below;
  if (!(own > 0.0)) return SourceChoice(kNoSource, 0.0, 0.0);
  return SourceChoice(low, clamp((target - below) / own, 0.0, 0.99999994), own / all);
}

bool is_emitters(uint source) { return source == params.light_count; }
bool is_environment(uint source) { return source == params.light_count + 1; }

#endif
