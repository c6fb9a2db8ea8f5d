#include "scene/gltf_properties.h"

#include <algorithm>
#include <array>

namespace lightwell {

namespace {

using enum GltfUse;

constexpr const char* kDiffuse = "surfaces are shown diffuse, with their base colour";
constexpr const char* kNoGloss = "surfaces are shown diffuse: no gloss";

constexpr GltfProperty kProperties[] = {
    {"any.name", kNothing},
    {"any.extras", kNothing},
    {"any.extensions", kShown, "see the table of extensions"},

    {"asset.version", kShown, "2.x"},
    {"asset.minVersion", kShown, "2.0"},
    {"asset.generator", kNothing},
    {"asset.copyright", kNothing},
    {"extensionsUsed", kShown},
    {"extensionsRequired", kShown},

    {"scene", kShown, "without it the first of the scenes"},
    {"scenes.nodes", kShown},

    {"nodes.children", kShown},
    {"nodes.matrix", kShown},
    {"nodes.translation", kShown},
    {"nodes.rotation", kShown},
    {"nodes.scale", kShown},
    {"nodes.mesh", kShown},
    {"nodes.skin", kShown},
    {"nodes.camera", kShown},
    {"nodes.weights", kShown},
    {"nodes.extensions.KHR_lights_punctual.light", kShown},
    {"nodes.extensions.KHR_node_visibility.visible", kShown, "its animation is not"},
    {"nodes.extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION", kShown},
    {"nodes.extensions.EXT_mesh_gpu_instancing.attributes.ROTATION", kShown},
    {"nodes.extensions.EXT_mesh_gpu_instancing.attributes.SCALE", kShown},
    {"nodes.extensions.EXT_mesh_gpu_instancing.attributes.COLOR_n", kIgnored, "colours of instances are not shown"},

    {"meshes.primitives.attributes.POSITION", kShown},
    {"meshes.primitives.attributes.NORMAL", kShown, "flat ones are made where there are none"},
    {"meshes.primitives.attributes.TANGENT", kNothing, "normal maps are not shown"},
    {"meshes.primitives.attributes.TEXCOORD_0", kShown},
    {"meshes.primitives.attributes.TEXCOORD_1", kShown},
    {"meshes.primitives.attributes.TEXCOORD_2", kShown},
    {"meshes.primitives.attributes.TEXCOORD_3", kShown},
    {"meshes.primitives.attributes.TEXCOORD_n", kIgnored, "texture coordinates beyond the fourth set are ignored"},
    {"meshes.primitives.attributes.COLOR_0", kShown, "multiplies the base colour"},
    {"meshes.primitives.attributes.COLOR_n", kIgnored, "vertex colours beyond the first set are ignored"},
    {"meshes.primitives.attributes.JOINTS_n", kShown, "the four largest influences of a vertex"},
    {"meshes.primitives.attributes.WEIGHTS_n", kShown},
    {"meshes.primitives.indices", kShown},
    {"meshes.primitives.material", kShown},
    {"meshes.primitives.mode", kShown, "triangles, strips and fans; points and lines are left out with a warning"},
    {"meshes.primitives.targets.POSITION", kShown},
    {"meshes.primitives.targets.NORMAL", kShown},
    {"meshes.primitives.targets.TANGENT", kNothing, "normal maps are not shown"},
    {"meshes.primitives.targets.TEXCOORD_n", kIgnored, "texture coordinates do not morph"},
    {"meshes.primitives.targets.COLOR_n", kIgnored, "vertex colours do not morph"},
    {"meshes.primitives.extensions.KHR_draco_mesh_compression.bufferView", kShown},
    {"meshes.primitives.extensions.KHR_draco_mesh_compression.attributes", kShown},
    {"meshes.weights", kShown},

    {"materials.pbrMetallicRoughness.baseColorFactor", kShown, "limited to 1"},
    {"materials.pbrMetallicRoughness.baseColorTexture", kShown},
    {"materials.pbrMetallicRoughness.metallicFactor", kApproximated, kDiffuse, "0"},
    {"materials.pbrMetallicRoughness.roughnessFactor", kApproximated, kNoGloss, "1"},
    {"materials.pbrMetallicRoughness.metallicRoughnessTexture", kApproximated, kDiffuse},
    {"materials.normalTexture", kIgnored, "normal maps are not shown"},
    {"materials.occlusionTexture", kIgnored, "occlusion maps are not shown: shadows are computed"},
    {"materials.emissiveTexture", kShown},
    {"materials.emissiveFactor", kShown},
    {"materials.alphaMode", kApproximated, "shown as an alpha mask with cutoff 0.5", "!BLEND"},
    {"materials.alphaCutoff", kShown},
    {"materials.doubleSided", kApproximated, "surfaces reflect on both sides; emission leaves the front only", "true"},
    {"materials.extensions.KHR_materials_emissive_strength.emissiveStrength", kShown},
    {"materials.extensions.KHR_materials_ior.ior", kIgnored, kNoGloss, "1.5"},
    {"materials.extensions.KHR_materials_specular.specularFactor", kIgnored, kNoGloss, "0"},
    {"materials.extensions.KHR_materials_specular.specularColorFactor", kIgnored, kNoGloss},
    {"materials.extensions.KHR_materials_specular.specularTexture", kIgnored, kNoGloss},
    {"materials.extensions.KHR_materials_specular.specularColorTexture", kIgnored, kNoGloss},
    {"materials.extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor", kShown, "as base colour"},
    {"materials.extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture", kShown, "as base colour"},
    {"materials.extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor", kApproximated, kNoGloss, "0"},
    {"materials.extensions.KHR_materials_pbrSpecularGlossiness.specularFactor", kApproximated, kNoGloss},
    {"materials.extensions.KHR_materials_pbrSpecularGlossiness.specularGlossinessTexture", kIgnored, kNoGloss},

    {"textureInfo.index", kShown},
    {"textureInfo.texCoord", kShown, "sets 0 to 3"},
    {"textureInfo.scale", kNothing, "of normal maps"},
    {"textureInfo.strength", kNothing, "of occlusion maps"},
    {"textureInfo.extensions.KHR_texture_transform.offset", kShown},
    {"textureInfo.extensions.KHR_texture_transform.rotation", kShown},
    {"textureInfo.extensions.KHR_texture_transform.scale", kShown},
    {"textureInfo.extensions.KHR_texture_transform.texCoord", kShown},

    {"textures.source", kShown},
    {"textures.sampler", kShown},
    {"textures.extensions.EXT_texture_webp.source", kShown},
    {"images.uri", kShown},
    {"images.bufferView", kShown},
    {"images.mimeType", kNothing, "the bytes say what they are"},
    {"samplers.magFilter", kShown},
    {"samplers.minFilter", kNothing, "textures are filtered over what a pixel covers"},
    {"samplers.wrapS", kShown},
    {"samplers.wrapT", kShown},

    {"extensions.KHR_lights_punctual.lights.type", kShown},
    {"extensions.KHR_lights_punctual.lights.color", kShown},
    {"extensions.KHR_lights_punctual.lights.intensity", kShown, "read as W/sr, of directional lights as W/m^2"},
    {"extensions.KHR_lights_punctual.lights.range", kShown},
    {"extensions.KHR_lights_punctual.lights.spot.innerConeAngle", kShown},
    {"extensions.KHR_lights_punctual.lights.spot.outerConeAngle", kShown},

    {"cameras.type", kShown},
    {"cameras.perspective.yfov", kShown},
    {"cameras.perspective.znear", kShown},
    {"cameras.perspective.zfar", kNothing, "nothing is cut off far away"},
    {"cameras.perspective.aspectRatio", kNothing, "the picture's size says it"},
    {"cameras.orthographic.ymag", kShown},
    {"cameras.orthographic.xmag", kNothing, "the picture's size says it"},
    {"cameras.orthographic.znear", kShown},
    {"cameras.orthographic.zfar", kNothing, "nothing is cut off far away"},

    {"skins.joints", kShown},
    {"skins.inverseBindMatrices", kShown},
    {"skins.skeleton", kNothing},
    {"animations.channels.sampler", kShown},
    {"animations.channels.target.node", kShown},
    {"animations.channels.target.path", kShown, "translation, rotation, scale and weights"},
    {"animations.samplers.input", kShown},
    {"animations.samplers.output", kShown},
    {"animations.samplers.interpolation", kShown},

    {"accessors.bufferView", kShown},
    {"accessors.byteOffset", kShown},
    {"accessors.componentType", kShown},
    {"accessors.normalized", kShown},
    {"accessors.count", kShown},
    {"accessors.type", kShown},
    {"accessors.min", kNothing},
    {"accessors.max", kNothing},
    {"accessors.sparse.count", kShown},
    {"accessors.sparse.indices.bufferView", kShown},
    {"accessors.sparse.indices.byteOffset", kShown},
    {"accessors.sparse.indices.componentType", kShown},
    {"accessors.sparse.values.bufferView", kShown},
    {"accessors.sparse.values.byteOffset", kShown},
    {"bufferViews.buffer", kShown},
    {"bufferViews.byteOffset", kShown},
    {"bufferViews.byteLength", kShown},
    {"bufferViews.byteStride", kShown},
    {"bufferViews.target", kNothing},
    {"bufferViews.extensions.EXT_meshopt_compression.buffer", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.byteOffset", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.byteLength", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.byteStride", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.count", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.mode", kShown},
    {"bufferViews.extensions.EXT_meshopt_compression.filter", kShown},
    {"buffers.uri", kShown},
    {"buffers.byteLength", kShown},
    {"buffers.extensions.EXT_meshopt_compression.fallback", kShown},
};

constexpr GltfExtension kExtensions[] = {
    {"KHR_lights_punctual", kShown},
    {"KHR_materials_emissive_strength", kShown},
    {"KHR_materials_pbrSpecularGlossiness", kShown, "its diffuse part"},
    {"KHR_mesh_quantization", kShown},
    {"KHR_node_visibility", kShown, "at rest"},
    {"KHR_texture_transform", kShown},
    {"EXT_mesh_gpu_instancing", kShown},
    {"EXT_texture_webp", kShown},
    {"KHR_draco_mesh_compression", kShown, "where Lightwell was built with Draco, else refused"},
    {"EXT_meshopt_compression", kShown, "where Lightwell was built with meshoptimizer, else refused"},
    {"KHR_materials_ior", kIgnored, kNoGloss},
    {"KHR_materials_specular", kIgnored, kNoGloss},
    {"KHR_materials_unlit", kIgnored, "unlit surfaces are shown lit"},
    {"KHR_materials_transmission", kIgnored, "transmission is not shown: surfaces are opaque"},
    {"KHR_materials_diffuse_transmission", kIgnored, "transmission is not shown: surfaces are opaque"},
    {"KHR_materials_volume", kIgnored, "volumes are not shown"},
    {"KHR_materials_volume_scatter", kIgnored, "volumes are not shown"},
    {"KHR_materials_clearcoat", kIgnored, "clear coats are not shown"},
    {"KHR_materials_sheen", kIgnored, "sheen is not shown"},
    {"KHR_materials_iridescence", kIgnored, "iridescence is not shown"},
    {"KHR_materials_anisotropy", kIgnored, "anisotropy is not shown"},
    {"KHR_materials_dispersion", kIgnored, "dispersion is not shown"},
    {"KHR_materials_variants", kIgnored, "the materials of the file itself are shown, no variant"},
    {"KHR_texture_basisu", kIgnored, "Basis textures are not read"},
    {"EXT_texture_avif", kIgnored, "AVIF textures are not read"},
    {"MSFT_texture_dds", kIgnored, "DDS textures are not read"},
    {"MSFT_lod", kIgnored, "the finest level of detail is shown"},
    {"EXT_lights_image_based", kIgnored, "its environment is not shown"},
    {"EXT_lights_ies", kIgnored, "light profiles are not shown"},
    {"KHR_animation_pointer", kIgnored, "only nodes and morph targets move"},
    {"KHR_node_hoverability", kNothing},
    {"KHR_node_selectability", kNothing},
    {"KHR_interactivity", kNothing},
    {"KHR_xmp", kNothing},
    {"KHR_xmp_json_ld", kNothing},
    {"KHR_audio_emitter", kNothing},
    {"KHR_physics_rigid_bodies", kNothing},
    {"KHR_implicit_shapes", kNothing},
    {"EXT_mesh_features", kNothing},
    {"EXT_instance_features", kNothing},
    {"EXT_structural_metadata", kNothing},
    {"GODOT_single_root", kNothing},
};

}  // namespace

const char* name_of(GltfUse use) {
  constexpr std::array<const char*, 4> kNames = {"shown", "approximated", "ignored", "nothing to show"};
  return kNames[static_cast<std::size_t>(use)];
}

std::span<const GltfProperty> gltf_properties() {
  return kProperties;
}

std::span<const GltfExtension> gltf_extensions() {
  return kExtensions;
}

bool can_show_without_loss_of_data(std::string_view extension) {
#if !LIGHTWELL_DRACO
  if (extension == "KHR_draco_mesh_compression") return false;
#endif
#if !LIGHTWELL_MESHOPT
  if (extension == "EXT_meshopt_compression") return false;
#endif
  for (const GltfExtension& known : kExtensions)
    if (extension == known.name) return true;
  constexpr std::array<std::string_view, 4> kAppearance = {"_materials_", "_texture_", "_lights_", "_xmp"};
  return std::any_of(kAppearance.begin(), kAppearance.end(),
                     [&](std::string_view part) { return extension.find(part) != std::string_view::npos; });
}

}  // namespace lightwell
