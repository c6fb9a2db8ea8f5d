// A host that lends a device and watches what is called on it. For tests only.
#pragma once

#include <atomic>
#include <cstring>
#include <map>
#include <string>

#include "gpu/device.h"

namespace lightwell {

// Lends the device of `owner`. One at a time: Vulkan's functions carry no user data.
class WatchedHost {
 public:
  explicit WatchedHost(const Device& owner) : owner_(owner) { current() = this; }
  ~WatchedHost() { current() = nullptr; }
  WatchedHost(const WatchedHost&) = delete;
  WatchedHost& operator=(const WatchedHost&) = delete;

  HostDevice lend() const {
    return {get_instance_function, owner_.instance(), owner_.physical_device(), owner_.handle(),
            owner_.queue_family(), owner_.queue(),    owner_.has_ray_query()};
  }

  // How often vkDeviceWaitIdle or vkDestroyDevice was called.
  std::atomic<int> meddling = 0;
  // Pipelines, their layouts and modules that still exist; and layouts of sets, which pipelines share.
  std::atomic<int> alive = 0;
  std::atomic<int> set_layouts_alive = 0;
  // So many of the next compute pipelines fail.
  std::atomic<int> failures = 0;

 private:
  static WatchedHost*& current() {
    static WatchedHost* host = nullptr;
    return host;
  }

  template <class Function>
  static Function real(const char* name) {
    const WatchedHost& host = *current();
    return reinterpret_cast<Function>(host.owner_.instance_table().vkGetDeviceProcAddr(host.owner_.handle(), name));
  }

  static PFN_vkVoidFunction VKAPI_PTR get_instance_function(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(get_device_function);
    return find_vulkan_loader()(instance, name);
  }

  static PFN_vkVoidFunction VKAPI_PTR get_device_function(VkDevice, const char* name) {
#define LW_WATCH(function) \
  { #function, reinterpret_cast < PFN_vkVoidFunction>(watched_##function) }
    static const std::map<std::string, PFN_vkVoidFunction> watched = {
        LW_WATCH(vkDeviceWaitIdle),
        LW_WATCH(vkDestroyDevice),
        LW_WATCH(vkCreateShaderModule),
        LW_WATCH(vkDestroyShaderModule),
        LW_WATCH(vkCreatePipelineLayout),
        LW_WATCH(vkDestroyPipelineLayout),
        LW_WATCH(vkCreateDescriptorSetLayout),
        LW_WATCH(vkDestroyDescriptorSetLayout),
        LW_WATCH(vkCreateComputePipelines),
        LW_WATCH(vkDestroyPipeline),
    };
#undef LW_WATCH
    const auto found = watched.find(name);
    return found == watched.end() ? real<PFN_vkVoidFunction>(name) : found->second;
  }

  static VkResult VKAPI_PTR watched_vkDeviceWaitIdle(VkDevice device) {
    ++current()->meddling;
    return real<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
  }
  static void VKAPI_PTR watched_vkDestroyDevice(VkDevice, const VkAllocationCallbacks*) {
    ++current()->meddling;
  }

#define LW_COUNT_CREATION(Object, counter)                                                                         \
  static VkResult VKAPI_PTR watched_vkCreate##Object(VkDevice device, const Vk##Object##CreateInfo* info,          \
                                                     const VkAllocationCallbacks* callbacks, Vk##Object* object) { \
    ++current()->counter;                                                                                          \
    return real<PFN_vkCreate##Object>("vkCreate" #Object)(device, info, callbacks, object);                        \
  }
#define LW_COUNT_DESTRUCTION(Object, counter)                                               \
  static void VKAPI_PTR watched_vkDestroy##Object(VkDevice device, Vk##Object object,       \
                                                  const VkAllocationCallbacks* callbacks) { \
    if (object) --current()->counter;                                                       \
    real<PFN_vkDestroy##Object>("vkDestroy" #Object)(device, object, callbacks);            \
  }
  LW_COUNT_CREATION(ShaderModule, alive)
  LW_COUNT_DESTRUCTION(ShaderModule, alive)
  LW_COUNT_CREATION(PipelineLayout, alive)
  LW_COUNT_DESTRUCTION(PipelineLayout, alive)
  LW_COUNT_CREATION(DescriptorSetLayout, set_layouts_alive)
  LW_COUNT_DESTRUCTION(DescriptorSetLayout, set_layouts_alive)
  LW_COUNT_DESTRUCTION(Pipeline, alive)
#undef LW_COUNT_CREATION
#undef LW_COUNT_DESTRUCTION

  static VkResult VKAPI_PTR watched_vkCreateComputePipelines(VkDevice device, VkPipelineCache cache,
                                                             std::uint32_t count,
                                                             const VkComputePipelineCreateInfo* infos,
                                                             const VkAllocationCallbacks* callbacks,
                                                             VkPipeline* pipelines) {
    if (current()->failures.fetch_sub(1) > 0) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    current()->alive += static_cast<int>(count);
    return real<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(device, cache, count, infos, callbacks,
                                                                          pipelines);
  }

  const Device& owner_;
};

}  // namespace lightwell
