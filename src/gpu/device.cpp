#include "gpu/device.h"

#include <algorithm>
#include <array>

#include "core/join.h"
#include "core/log.h"
#include "gpu/device_select.h"
#include "gpu/pipeline_cache.h"
#include "gpu/pipeline_cache_file.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// Messages that are known to be false, with the reason. At most five.
constexpr std::array<const char*, 0> kFalseMessages{};

VkBool32 VKAPI_PTR on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const std::string id = data->pMessageIdName ? data->pMessageIdName : "";
  for (const char* known : kFalseMessages)
    if (id == known) return VK_FALSE;
  std::string text = data->pMessage ? data->pMessage : "";
  std::replace(text.begin(), text.end(), '\n', ' ');
  static_cast<std::vector<std::string>*>(user)->push_back(text);
  log_warning("validation: " + text);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>* messages) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = on_message;
  info.pUserData = messages;
  return info;
}

bool has_layer(PFN_vkGetInstanceProcAddr get, const char* name) {
  auto enumerate =
      reinterpret_cast<PFN_vkEnumerateInstanceLayerProperties>(get(nullptr, "vkEnumerateInstanceLayerProperties"));
  std::uint32_t count = 0;
  enumerate(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  enumerate(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [&](const VkLayerProperties& l) { return std::string_view(l.layerName) == name; });
}

bool has_debug_utils(PFN_vkGetInstanceProcAddr get, const char* layer) {
  auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(
      get(nullptr, "vkEnumerateInstanceExtensionProperties"));
  std::uint32_t count = 0;
  enumerate(layer, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  enumerate(layer, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& e) {
    return std::string_view(e.extensionName) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  });
}

}  // namespace

Device::Device(const DeviceOptions& options) {
  const PFN_vkGetInstanceProcAddr get = find_vulkan_loader();
  if (!get) throw InputError("Vulkan", "no Vulkan loader found; install libvulkan1 and a driver (mesa-vulkan-drivers)");
  create_instance(get, options.validation);
  try {
    choose_physical_device(options.device);
    create_device();
    finish_setup();
  } catch (...) {
    if (device_) vk_.vkDestroyDevice(device_, nullptr);
    if (messenger_) instance_table_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    instance_table_.vkDestroyInstance(instance_, nullptr);
    throw;
  }
}

Device::Device(const HostDevice& host)
    : owned_(false),
      instance_(host.instance),
      physical_device_(host.physical_device),
      device_(host.device),
      queue_(host.queue),
      queue_family_(host.queue_family) {
  instance_table_ = InstanceTable(host.get_instance_proc_addr, instance_);
  const CandidateDevice candidate = examine_device(instance_table_, physical_device_);
  if (!candidate.summary.missing.empty())
    throw InputError(candidate.summary.name, "the host's device lacks " + join(candidate.summary.missing));
  if (host.ray_query && !candidate.summary.ray_query)
    throw InputError(candidate.summary.name, "the host's device has no ray queries");
  summary_ = candidate.summary;
  ray_query_ = host.ray_query;
  choice_reason_ = "lent by the host application";
  finish_setup();
}

void Device::create_instance(PFN_vkGetInstanceProcAddr get, bool validation) {
  constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";
  if (validation && !has_layer(get, kLayer))
    throw InputError("validation", "the Khronos validation layer is not installed (vulkan-validationlayers)");
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "Lightwell";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  debug_utils_ = has_debug_utils(get, nullptr) || (validation && has_debug_utils(get, kLayer));
  if (debug_utils_) {
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  if (validation) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kLayer;
    info.pNext = &features;
  }
  auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  const VkResult result = create(&info, nullptr, &instance_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw InputError("Vulkan", "no driver found; a software one is in the package mesa-vulkan-drivers");
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY)  // also what the loader says of a manifest that is no JSON
    throw InputError("Vulkan",
                     "no driver could be loaded: a driver's manifest is malformed, or memory is short "
                     "(VK_LOADER_DEBUG=error says more)");
  check_vk(result, "vkCreateInstance");
  instance_table_ = InstanceTable(get, instance_);
  if (validation) {
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages_.get());
    LW_VK(instance_table_.vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_));
  }
}

void Device::choose_physical_device(const std::string& wanted) {
  const std::vector<CandidateDevice> candidates = examine_devices(instance_table_, instance_);
  const DeviceChoice choice = choose_device(candidates, wanted);
  physical_device_ = candidates[choice.index].handle;
  summary_ = candidates[choice.index].summary;
  ray_query_ = summary_.ray_query;
  choice_reason_ = choice.reason;
}

void Device::create_device() {
  std::uint32_t count = 0;
  instance_table_.vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance_table_.vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const auto family = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& f) {
    return (f.queueFlags & kWanted) == kWanted;
  });
  queue_family_ = static_cast<std::uint32_t>(family - families.begin());

  const RequiredFeatures required(ray_query_);
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue_info.queueFamilyIndex = queue_family_;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &required.features};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  info.enabledExtensionCount = static_cast<std::uint32_t>(required.extensions.size());
  info.ppEnabledExtensionNames = required.extensions.data();
  LW_VK(instance_table_.vkCreateDevice(physical_device_, &info, nullptr, &device_));
  vk_ = DeviceTable(instance_table_.vkGetDeviceProcAddr, device_);
  vk_.vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

void Device::finish_setup() {
  if (!owned_) {
    vk_ = DeviceTable(instance_table_.vkGetDeviceProcAddr, device_);
    debug_utils_ = instance_table_.vkCmdBeginDebugUtilsLabelEXT != nullptr;
  }
  VkPhysicalDeviceAccelerationStructurePropertiesKHR acceleration_structures{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
  VkPhysicalDeviceMaintenance4Properties sizes{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES,
                                               ray_query_ ? &acceleration_structures : nullptr};
  VkPhysicalDeviceMaintenance3Properties allocations{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES,
                                                     &sizes};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &allocations};
  instance_table_.vkGetPhysicalDeviceProperties2(physical_device_, &properties);
  limits_ = properties.properties.limits;
  largest_buffer_ = std::min<std::uint64_t>(sizes.maxBufferSize, allocations.maxMemoryAllocationSize);
  descriptor_range_ = limits_.maxStorageBufferRange;
  scratch_alignment_ = std::max(1u, acceleration_structures.minAccelerationStructureScratchOffsetAlignment);
  std::uint32_t count = 0;
  instance_table_.vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance_table_.vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, families.data());
  timestamp_bits_ = families[queue_family_].timestampValidBits;
  memory_ = std::make_unique<MemoryPool>(*this);
  // A host keeps files of its own, if it wants to.
  pipelines_ = std::make_unique<PipelineCache>(*this, owned_ ? pipeline_cache_path(properties.properties) : "");
}

Device::~Device() {
  LW_ASSERT(!deferred_.has_open_timelines(), std::string("a Renderer outlives its Device"));
  pipelines_.reset();
  for (const VkSampler sampler : samplers_)
    if (sampler) vk_.vkDestroySampler(device_, sampler, nullptr);
  memory_.reset();
  if (!owned_) return;
  vk_.vkDestroyDevice(device_, nullptr);
  if (messenger_) instance_table_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  instance_table_.vkDestroyInstance(instance_, nullptr);
}

std::uint64_t Device::timestamp_mask() const {
  return timestamp_bits_ >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << timestamp_bits_) - 1;
}

VkSampler Device::sampler(std::uint8_t kind) {
  if (samplers_.size() <= kind) samplers_.resize(kind + 1u, VK_NULL_HANDLE);
  if (samplers_[kind]) return samplers_[kind];
  const bool linear = kind == 1 || kind == 2 || kind == 4;  // SamplerKind: see graph/frame_graph.h
  const bool repeat = kind == 2 || kind == 3;
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  info.mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW =
      repeat ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = VK_LOD_CLAMP_NONE;
  if (kind == 4) {
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
  }
  LW_VK(vk_.vkCreateSampler(device_, &info, nullptr, &samplers_[kind]));
  return samplers_[kind];
}

VkImageUsageFlags Device::usages(VkFormat format) const {
  VkFormatProperties properties;
  instance_table_.vkGetPhysicalDeviceFormatProperties(physical_device_, format, &properties);
  const VkFormatFeatureFlags features = properties.optimalTilingFeatures;
  VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
  if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  if (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  return usage;
}

void Device::set_name(VkObjectType type, std::uint64_t handle, std::string_view name) {
  if (!debug_utils_ || !instance_table_.vkSetDebugUtilsObjectNameEXT) return;
  const std::string text(name);
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = text.c_str();
  instance_table_.vkSetDebugUtilsObjectNameEXT(device_, &info);
}

void DeviceDeleter::operator()(Device* device) const {
  delete device;
}
DevicePtr open_device(const DeviceOptions& options) {
  return DevicePtr(new Device(options));
}
DevicePtr wrap_device(const HostDevice& host) {
  return DevicePtr(new Device(host));
}

}  // namespace lightwell
