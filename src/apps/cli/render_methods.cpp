#include "apps/cli/render_methods.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "apps/cli/memory_check.h"
#include "apps/cli/text.h"
#include "core/log.h"
#include "gpu/device.h"
#include "lightwell/error.h"
#include "lightwell/path_tracer.h"
#include "lightwell/photon_mapper.h"
#include "techniques/technique.h"

namespace lightwell {

namespace {

// The options of a renderer on the CPU, and how often it is used.
template <class Options>
struct CpuFrames {
  Options options;
  int frames = 0;

  void describe(OptionVisitor& visitor) {
    options.describe(visitor);
    visitor.visit({"frames", "Pictures of an animated scene, from --time on; 0: one.", "", "time in proportion"},
                  frames, 0, 1000000);
  }
};

void render_moment(const RenderJob& job, const Moment& moment, const PathTracerOptions& options,
                   const std::function<void(float)>& progress, RenderResult& result) {
  PathTracerOptions own = options;
  own.variance = job.variance;
  result.picture = PathTracer(job.scene, moment.world).render(moment.camera, own, progress);
}

void render_moment(const RenderJob& job, const Moment& moment, const PhotonMapperOptions& options,
                   const std::function<void(float)>& progress, RenderResult& result) {
  check_photon_mapper_memory({options.width, options.height});
  PhotonMapping mapping = PhotonMapper(job.scene, moment.world).render(moment.camera, options, progress);
  result.picture = std::move(mapping.picture);
  result.photon_mapper = mapping.statistics;
}

// Pictures do not depend on each other: those that nobody wants are left out.
template <class Options>
RenderResult render_on_cpu(const RenderJob& job, const std::string& technique) {
  CpuFrames<Options> wanted;
  for (const std::string& assignment : job.assignments)
    set_option([&](OptionVisitor& visitor) { wanted.describe(visitor); }, assignment);
  if (wanted.frames > 0 && !job.play)
    throw InputError("--frames",
                     "--technique " + technique + " has frames of animated scenes only, and this one is static");
  wanted.options.width = job.width;
  wanted.options.height = job.height;

  const int end = std::max(wanted.frames, 1);
  const int begin = job.each_frame ? 0 : end - 1;
  RenderResult result;
  for (int frame = begin; frame < end; ++frame) {
    const Moment moment = frame == 0 ? job.start : job.play(frame);
    const auto progress = [&](float done) {
      if (job.progress) job.progress((static_cast<float>(frame - begin) + done) / static_cast<float>(end - begin));
    };
    render_moment(job, moment, wanted.options, progress, result);
    if (job.each_frame) job.each_frame(frame, result);
  }
  return result;
}

template <class Options>
RenderMethod cpu_method(const std::string& name, const std::string& help) {
  RenderMethod method;
  method.name = name;
  method.help = help;
  method.own_options = [](const std::string&) -> DescribeOptions {
    const auto options = std::make_shared<CpuFrames<Options>>();
    return [options](OptionVisitor& visitor) { options->describe(visitor); };
  };
  method.render = [name](const RenderJob& job) { return render_on_cpu<Options>(job, name); };
  return method;
}

// How many pictures a job is. Leaves in `options.frames` what each of them takes.
int count_pictures(const RenderJob& job, RendererOptions& options) {
  const int wanted = options.frames;
  if (job.play && wanted > 0) {
    options.frames = options.samples;  // all of them in the film
    return wanted;
  }
  if (!job.each_frame) return 1;
  options.frames = 1;
  return wanted > 0 ? wanted : kMaximumFrames;
}

RenderResult render_on_gpu(const RenderJob& job, const std::string& technique) {
  RendererOptions options = renderer_options(job, technique);
  const bool until_steady = options.frames == 0;
  const int pictures = count_pictures(job, options);
  const bool plays = job.play && !until_steady;
  Device device({job.gpu.device, job.gpu.validation});
  check_frame_memory({job.width, job.height}, device);
  log_info("device " + device.summary().name + ": " + device.choice_reason());

  Renderer renderer(device, job.scene, job.start.world, options);
  RenderResult result;
  result.device = device.summary().name;
  const double frames = static_cast<double>(pictures) * options.frames;
  Moment moment = job.start;
  for (int picture = 0; picture < pictures; ++picture) {
    if (plays && picture > 0) moment = job.play(picture);
    // Before an animation starts the scene was static: its first frame lacks no light.
    const FrameView view{&moment.world, moment.camera, false, plays && picture == 0, moment.time};
    result.picture = renderer.render(view, [&](int done) {
      if (job.progress && !until_steady && frames > 1)
        job.progress(static_cast<float>((static_cast<double>(picture) * options.frames + done) / frames));
    });
    result.statistics = renderer.statistics();
    result.debug_images = renderer.debug_images();
    if (job.each_frame) job.each_frame(picture, result);
    if (until_steady && result.statistics->steady) break;
  }
  if (!device.validation_messages().empty())
    throw InputError("--validation",
                     std::to_string(device.validation_messages().size()) + " messages of the validation layer");
  if (until_steady && !result.statistics->steady)
    log_warning("--technique " + technique + ": stopped after " + std::to_string(kMaximumFrames) +
                " frames, still changing");
  return result;
}

RenderMethod gpu_method(const TechniqueInfo* info) {
  RenderMethod method;
  method.name = info ? std::string(info->name) : "none";
  method.help = info ? std::string(info->summary) : "Direct light only.";
  method.on_gpu = true;
  method.has_statistics = true;
  if (info) method.presets.assign(info->presets.begin(), info->presets.end());
  method.own_options = [info](const std::string& preset) -> DescribeOptions {
    const std::shared_ptr<Technique> technique = info ? info->create(preset) : nullptr;
    return [technique](OptionVisitor& visitor) {
      if (technique) technique->describe(visitor);
    };
  };
  method.render = [name = method.name](const RenderJob& job) { return render_on_gpu(job, name); };
  return method;
}

}  // namespace

DescribeOptions shared_options() {
  const auto options = std::make_shared<RendererOptions>();
  return [options](OptionVisitor& visitor) { options->describe(visitor); };
}

DescribeOptions all_options(const RenderMethod& method, const std::string& preset) {
  const DescribeOptions own = method.own_options(preset);
  if (!method.on_gpu) return own;
  return [own, shared = shared_options()](OptionVisitor& visitor) {
    own(visitor);
    shared(visitor);
  };
}

// "name=value" belongs to the renderer if it has an option of that name, else to the technique.
RendererOptions renderer_options(const RenderJob& job, const std::string& technique) {
  RendererOptions options;
  const DescribeOptions describe = [&](OptionVisitor& visitor) { options.describe(visitor); };
  std::vector<std::string> own;
  for (const OptionText& option : list_options(describe)) own.push_back(option.name);
  for (const std::string& assignment : job.assignments) {
    const std::string name = assignment.substr(0, assignment.find('='));
    if (std::find(own.begin(), own.end(), name) != own.end())
      set_option(describe, assignment);
    else
      options.technique_options.push_back(assignment);
  }
  options.width = job.width;
  options.height = job.height;
  options.technique = technique;
  options.preset = job.preset;
  options.grid_bounds = job.gpu.grid_bounds;
  options.debug_views = job.gpu.debug_views;
  return options;
}

std::vector<RenderMethod> make_render_methods() {
  std::vector<RenderMethod> methods;
  for (const TechniqueInfo* info : techniques()) methods.push_back(gpu_method(info));
  methods.push_back(gpu_method(nullptr));
  methods.push_back(cpu_method<PathTracerOptions>("path-tracer", "The ground truth: unbiased, on the CPU, slow."));
  methods.back().has_variance = true;
  methods.push_back(cpu_method<PhotonMapperOptions>(
      "photon-mapping", "A second truth: photons from the lights, on the CPU; blurred until it is progressive."));
  methods.back().has_statistics = true;
  return methods;
}

const RenderMethod& find_render_method(const std::vector<RenderMethod>& methods, const std::string& name) {
  std::vector<std::string> names;
  for (const RenderMethod& method : methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw InputError("--technique", "'" + name + "' is not one of " + join(names));
}

std::string find_preset(const RenderMethod& method, const std::string& wanted) {
  if (wanted.empty()) return method.presets.empty() ? "" : method.presets.front();
  if (std::find(method.presets.begin(), method.presets.end(), wanted) != method.presets.end()) return wanted;
  if (method.presets.empty()) throw InputError("--preset", "--technique " + method.name + " has none");
  throw InputError("--preset", "'" + wanted + "' is not one of " + join(method.presets));
}

}  // namespace lightwell
