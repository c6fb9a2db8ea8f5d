// glTF files that hold, together, everything that the importer reads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/test_files.h"

namespace lightwell::test {

// Everything that the glTF importer reads, in one small file.
inline GltfBuilder gltf_parts(std::string& rest) {
  GltfBuilder b;
  const auto n = [](int value) { return std::to_string(value); };
  const std::string position = n(b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
  const std::string normal = n(b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  const std::string uv = n(b.vec2({0, 0, 1, 0, 0, 1, 1, 1}));
  const std::string index = n(b.indices({0, 1, 2, 2, 1, 3}));
  const std::string joints = n(b.accessor(R"("bufferView":)" + n(b.view(std::vector<std::uint8_t>(16, 0))) +
                                          R"(,"componentType":5121,"type":"VEC4","count":4)"));
  const std::string weights = n(b.floats("VEC4", 4, std::vector<float>(16, 0.25f)));
  const std::string bind = n(b.floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  const std::string more_weights = n(b.floats("VEC4", 4, std::vector<float>(16, 0.5f)));
  const std::string places = n(b.view(std::vector<std::uint16_t>{1, 3}));
  const std::string values = n(b.view(std::vector<float>{7, 0, 0, 8, 8, 0}));
  const std::string sparse =
      n(b.accessor(R"("componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":)" +
                   places + R"(,"componentType":5123},"values":{"bufferView":)" + values + "}}"));
  const std::string times = n(b.floats("SCALAR", 1, {0, 1}));
  const std::string moves = n(b.vec3({0, 0, 0, 1, 0, 0}));
  const std::string turns =
      n(b.accessor(R"("bufferView":)" + n(b.view(std::vector<std::int16_t>{0, 0, 0, 32767, 32767, 0, 0, 0})) +
                   R"(,"componentType":5122,"normalized":true,"type":"VEC4","count":2)"));
  const std::string grows = n(b.vec3({0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0, 2, 1, 1, 0, 0, 0}));
  const std::string melts = n(b.floats("SCALAR", 1, {0, 1}));
  rest =
      R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1,2]},{"mesh":0,"skin":0,"translation":[1,2,3],"scale":[1,2,1]},
    {"mesh":1,"camera":0,"rotation":[0,0.6,0,0.8],"extensions":{"KHR_lights_punctual":{"light":0}},"children":[3]},
    {"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,4,5,6,1]}],"meshes":[{"weights":[0.5],"primitives":[{"material":0,"indices":)" +
      index + R"(,"attributes":{"POSITION":)" + position + R"(,"NORMAL":)" + normal + R"(,"TEXCOORD_0":)" + uv +
      R"(,"JOINTS_0":)" + joints + R"(,"WEIGHTS_0":)" + weights + R"(,"JOINTS_1":)" + joints + R"(,"WEIGHTS_1":)" +
      more_weights + R"(},"targets":[{"POSITION":)" + sparse +
      R"(}]}]},{"primitives":[{"mode":5,"attributes":{"POSITION":)" + position +
      R"(}},{"mode":6,"attributes":{"POSITION":)" + sparse + R"(}}]}],"skins":[{"joints":[3],"inverseBindMatrices":)" +
      bind +
      R"(}],"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1,"zfar":100}}],"animations":[{"channels":[
    {"sampler":0,"target":{"node":3,"path":"translation"}},{"sampler":1,"target":{"node":2,"path":"rotation"}},
    {"sampler":2,"target":{"node":0,"path":"scale"}}],"samplers":[{"input":)" +
      times + R"(,"output":)" + moves + R"(},{"input":)" + times + R"(,"output":)" + turns + R"(},{"input":)" + times +
      R"(,"output":)" + grows + R"(,"interpolation":"CUBICSPLINE"}]},{"name":"melt","channels":[{"sampler":0,"target":
    {"node":1,"path":"weights"}}],"samplers":[{"input":)" +
      times + R"(,"output":)" + melts + R"(,"interpolation":"STEP"}]}],
    "extensionsRequired":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,1,1],
    "intensity":5,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}}]}},"images":[{"uri":"p.png"}],"samplers":[{"wrapS":33071}],
    "textures":[{"source":0,"sampler":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{
    "KHR_texture_transform":{"offset":[0.5,0],"rotation":1,"scale":[2,2]}}}},"emissiveFactor":[1,1,1],"alphaMode":"MASK",
    "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}}])";
  return b;
}

// What gltf_parts() has not: colours, texture sets, instances, quantised and strided vertices, other materials.
inline GltfBuilder more_gltf_parts(std::string& rest) {
  GltfBuilder b;
  const auto n = [](int value) { return std::to_string(value); };
  const std::string quantized =
      n(b.accessor(R"("bufferView":)" +
                   n(b.view(std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, 32767, 0, 0},
                            R"(,"byteStride":8,"target":34962)")) +
                   R"(,"componentType":5122,"normalized":true,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0])"));
  const std::string normal =
      n(b.accessor(R"("bufferView":)" +
                   n(b.view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, R"(,"byteStride":4)")) +
                   R"(,"componentType":5120,"normalized":true,"type":"VEC3","count":3)"));
  const std::string color =
      n(b.accessor(R"("bufferView":)" + n(b.view(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 9, 0, 0, 9, 1})) +
                   R"(,"componentType":5121,"normalized":true,"type":"VEC4","count":3)"));
  const std::string uv =
      n(b.accessor(R"("bufferView":)" + n(b.view(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535})) +
                   R"(,"componentType":5123,"normalized":true,"type":"VEC2","count":3)"));
  const std::string index = n(b.accessor(R"("bufferView":)" + n(b.view(std::vector<std::uint8_t>{0, 1, 2})) +
                                         R"(,"componentType":5121,"type":"SCALAR","count":3)"));
  const std::string places = n(b.vec3({0, 0, 0, 4, 0, 0}));
  const std::string sizes = n(b.vec3({1, 1, 1, 2, -1, 0.5f}));
  const std::string turns = n(b.floats("VEC4", 4, {0, 0, 0, 1, 0, 1, 0, 0}));
  rest =
      R"("extensionsRequired":["KHR_mesh_quantization","EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"extensions":
    {"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" +
      places + R"(,"SCALE":)" + sizes + R"(,"ROTATION":)" + turns +
      R"(}}}},{"name":"eye","camera":0,"translation":[0,0,9]},{"mesh":0,"scale":[-1,1,1],"extensions":
    {"KHR_node_visibility":{"visible":false}}}],"cameras":[{"type":"orthographic","orthographic":{"xmag":2,"ymag":2,
    "znear":0.1,"zfar":50}}],"meshes":[{"name":"m","primitives":[{"material":0,"indices":)" +
      index + R"(,"attributes":{"POSITION":)" + quantized + R"(,"NORMAL":)" + normal + R"(,"COLOR_0":)" + color +
      R"(,"TEXCOORD_0":)" + uv + R"(,"TEXCOORD_1":)" + uv + R"(,"_ID":)" + uv +
      R"(}},{"mode":1,"attributes":{"POSITION":)" + quantized +
      R"(}}]}],"images":[{"uri":"p.png"},{"bufferView":0,"mimeType":"image/png"}],"samplers":[{"wrapS":33648,"magFilter":9728,
    "minFilter":9987}],"textures":[{"source":0,"sampler":0},{"source":1,"extensions":{"EXT_texture_webp":{"source":0}}}],
    "materials":[{"doubleSided":true,"normalTexture":{"index":0,"scale":2},"emissiveTexture":{"index":1},"emissiveFactor":
    [1,0,0],"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],"baseColorTexture":{"index":0,
    "texCoord":1}},"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0.5,0,1],"diffuseTexture":
    {"index":0}},"KHR_materials_clearcoat":{"clearcoatFactor":1}}}])";
  return b;
}

}  // namespace lightwell::test
