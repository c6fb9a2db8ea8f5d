#include "apps/cli/render_methods.h"

#include <memory>

#include "apps/cli/text.h"
#include "lightwell/error.h"
#include "lightwell/path_tracer.h"

namespace lightwell {

namespace {

RenderMethod path_tracer_method() {
  const auto options = std::make_shared<PathTracerOptions>();
  RenderMethod method;
  method.name = "path-tracer";
  method.help = "The ground truth: unbiased, on the CPU, slow.";
  method.describe = [options](OptionVisitor& visitor) { options->describe(visitor); };
  method.render = [options](const RenderJob& job) {
    options->width = job.width;
    options->height = job.height;
    return PathTracer(job.scene, job.snapshot).render(job.camera, *options, job.progress);
  };
  return method;
}

}  // namespace

std::vector<RenderMethod> make_render_methods() {
  return {path_tracer_method()};
}

const RenderMethod& find_render_method(const std::vector<RenderMethod>& methods, const std::string& name) {
  std::vector<std::string> names;
  for (const RenderMethod& method : methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw InputError("--technique", "'" + name + "' is not one of " + join(names));
}

}  // namespace lightwell
