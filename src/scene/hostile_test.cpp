// Files made to hurt: each must end in one line that names the file, soon, without much memory.
#include <sys/resource.h>

#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "core/log.h"
#include "lightwell/metrics.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Repeated with commas between.
std::string list_of(const std::string& item, int count) {
  return item + repeated("," + item, count - 1);
}

class Hostile : public testing::Test {
 protected:
  Hostile() : start_(std::clock()), memory_(peak_memory_mib()) { set_log_level(LogLevel::kQuiet); }
  ~Hostile() override {
    set_log_level(LogLevel::kWarning);
    // Of this process: others on the machine do not count. Whoever waits for ever meets the test's time limit.
    EXPECT_LT(static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC, 20.0);
    EXPECT_LT(peak_memory_mib() - memory_, 1024);
  }

  static long peak_memory_mib() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
  }

  void expect_error(const std::string& name, const std::string& content) {
    const std::string error = folder_.error(name, content);
    EXPECT_TRUE(error.starts_with(folder_.path(""))) << "'" << error << "' for " << content.substr(0, 400);
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  void expect_gltf_error(const std::string& rest) { expect_error("a.gltf", gltf_of(rest)); }
  // An accessor used as the positions of a strip.
  void expect_accessor_error(GltfBuilder builder, const std::string& fields) {
    const int accessor = builder.accessor(fields);
    expect_error("a.gltf",
                 one_primitive(builder, R"("mode":5,"attributes":{"POSITION":)" + std::to_string(accessor) + "}"));
  }

  TempFolder folder_;
  std::clock_t start_;
  long memory_;
};

TEST_F(Hostile, AccessorsBeyondTheirData) {
  GltfBuilder builder;
  builder.view(std::vector<float>(9, 0.0f));
  builder.view(std::vector<float>(9, 0.0f), R"(,"byteStride":4)");
  builder.view(std::vector<float>(9, 0.0f), R"(,"byteStride":9007199254740992)");
  const std::string type = R"("type":"VEC3","componentType":5126,)";
  const std::string view = R"("bufferView":0,)" + type;
  for (const std::string& fields :
       {view + R"("count":4)", view + R"("count":4294967295)", view + R"("count":9007199254740992)",
        view + R"("count":-1)", view + R"("count":1.5)", view + R"("count":"3")", view + R"("count":3,"byteOffset":4)",
        view + R"("count":3,"byteOffset":9007199254740991)", std::string(R"("bufferView":1,)") + type + R"("count":2)",
        std::string(R"("bufferView":2,)") + type + R"("count":2)",
        std::string(R"("bufferView":3,)") + type + R"("count":2)", type + R"("count":4294967295)",
        type + R"("count":100000000)", std::string(R"("bufferView":0,"type":"VEC3","componentType":1,"count":1)"),
        std::string(R"("bufferView":0,"type":"VEC9","componentType":5126,"count":1)"),
        std::string(R"("bufferView":0,"type":"VEC2","componentType":5126,"count":3)"),
        std::string(R"("bufferView":0,"type":"MAT4","componentType":5121,"count":1)")})
    expect_accessor_error(builder, fields);
}

TEST_F(Hostile, SparseAccessors) {
  GltfBuilder builder;
  builder.view(std::vector<float>(9, 0.0f));
  builder.view(std::vector<std::uint8_t>{0, 200});
  const auto sparse = [](const std::string& count, const std::string& indices, const std::string& values) {
    return R"("type":"VEC3","componentType":5126,"count":3,"sparse":{"count":)" + count + R"(,"indices":{)" + indices +
           R"(},"values":{)" + values + "}}";
  };
  const std::string good = R"("bufferView":1,"componentType":5121)";
  expect_accessor_error(builder, sparse("2", good, R"("bufferView":0)"));  // 200 of 3
  expect_accessor_error(builder, sparse("4", good, R"("bufferView":0)"));
  expect_accessor_error(builder, sparse("3", good, R"("bufferView":0)"));
  expect_accessor_error(builder, sparse("1", R"("bufferView":1,"componentType":5126)", R"("bufferView":0)"));
  expect_accessor_error(builder, sparse("1", good, ""));
  expect_accessor_error(builder, sparse("1", good, R"("bufferView":0,"byteOffset":28)"));
}

TEST_F(Hostile, BuffersAndViewsBeyondTheirData) {
  const std::string triangle = R"("accessors":[{"bufferView":0,"type":"VEC3","componentType":5126,"count":1}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)";
  const std::string data = R"("buffers":[{"byteLength":12,"uri":"data:a;base64,AAAAAAAAAAAAAAAA"}])";
  EXPECT_EQ(folder_.error("a.gltf", gltf_of(triangle + R"("bufferViews":[{"buffer":0,"byteLength":12}],)" + data)), "");
  for (const char* view : {R"({"buffer":0,"byteLength":13})", R"({"buffer":1,"byteLength":1})", R"({"byteLength":1})",
                           "7", R"({"buffer":0,"byteOffset":9007199254740991,"byteLength":9007199254740991})",
                           R"({"buffer":0,"byteOffset":-4,"byteLength":12})"})
    expect_gltf_error(triangle + R"("bufferViews":[)" + view + "]," + data);
  for (const char* buffer :
       {R"({"byteLength":13,"uri":"data:a;base64,AAAAAAAAAAAAAAAA"})", R"({"byteLength":12})",
        R"({"byteLength":12,"uri":"data:a;base64,AAAA*AAAAAAAAAAA"})", R"({"byteLength":12,"uri":"data:a,AA"})",
        R"({"byteLength":12,"uri":"https://example.org/a.bin"})", R"({"byteLength":12,"uri":"none.bin"})",
        R"({"byteLength":12,"uri":"."})", R"({"byteLength":12,"uri":"a%00b"})",
        R"({"byteLength":100000,"uri":"a.gltf"})"})
    expect_gltf_error(triangle + R"("bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[)" + buffer + "]");
}

TEST_F(Hostile, IndicesBeyondTheirArrays) {
  for (const char* rest :
       {R"("nodes":[{"mesh":0}])", R"("nodes":[{"camera":0}])", R"("nodes":[{"skin":0}])", R"("scene":3,"scenes":[])",
        R"("scenes":[{"nodes":[0]}])", R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])",
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])", R"("skins":[{"joints":[0]}])",
        R"("skins":[{"joints":[]}])", R"("animations":[{"channels":[{"sampler":0,"target":{}}]}])",
        R"("materials":[{"emissiveTexture":{"index":0}}])", R"("materials":[{"emissiveTexture":{}}])",
        R"("textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}])",
        R"("textures":[{"sampler":0}],"materials":[{"emissiveTexture":{"index":0}}])"})
    expect_gltf_error(rest);
  // An image without its data is one that is missing.
  EXPECT_EQ(folder_.error("a.gltf", gltf_of(R"("images":[{"bufferView":0}],"textures":[{"source":0}],"materials":[{
          "emissiveTexture":{"index":0}}])")),
            "");
  GltfBuilder builder;
  const std::string position = std::to_string(builder.vec3(std::vector<float>(9, 0.0f)));
  const std::string index = std::to_string(builder.indices({0, 1, 3}));
  expect_error("a.gltf", one_primitive(builder, R"("attributes":{"POSITION":)" + position + R"(},"indices":)" + index));
  expect_error("a.gltf", one_primitive(builder, R"("material":0,"attributes":{"POSITION":)" + position + "}"));
  expect_error("a.gltf",
               one_primitive(builder, R"("attributes":{"POSITION":)" + position + R"(},"indices":)" + position));
}

TEST_F(Hostile, WrongTypesAndNumbers) {
  for (const char* rest :
       {R"("nodes":5)", R"("nodes":[5])", R"("nodes":[{"children":5}])", R"("nodes":[{"children":[-1]}])",
        R"("nodes":[{"children":[0.5]}])", R"("nodes":[{"children":[1e300]}])", R"("extensions":[])",
        R"("materials":[{"doubleSided":1}])", R"("extensionsRequired":[5])", R"("extensionsRequired":5)"})
    expect_gltf_error(rest);
}

TEST_F(Hostile, BrokenJson) {
  for (const char* text :
       {"", " ", "{", "[]", "null", "5", R"({"asset":{"version":"1.0"}})", R"({"asset":{"version":2}})", "{}",
        R"({"asset":{"version":"2.0","minVersion":"2.1"}})", "\xff\xfe{}", "{\"asset\":{\"version\":\"2.\xff\"}}",
        R"({"asset":{"version":"2.0"},"x":1e999999})"})
    expect_error("a.gltf", text);
  expect_error("a.gltf", repeated("[", 3000000));
  expect_error("a.gltf", repeated("{\"a\":", 1000000));
}

TEST_F(Hostile, BrokenGlb) {
  GltfBuilder builder;
  const std::string position = std::to_string(builder.vec3(std::vector<float>(9, 0.0f)));
  const std::string good =
      builder.glb(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position + "}}]}]");
  ASSERT_EQ(folder_.error("a.glb", good), "");
  for (std::size_t size = 0; size + 1 < good.size(); size += 3) expect_error("a.glb", good.substr(0, size));
  for (const std::size_t at : {4u, 8u, 12u, 16u})
    for (const char byte : {'\x00', '\x7f', '\xff'}) {
      std::string bad = good;
      bad.replace(at, 4, 4, byte);
      if (bad != good) expect_error("a.glb", bad);
    }
}

TEST_F(Hostile, SmallFilesThatUnfoldIntoMuch) {
  // One accessor without data, used by very many primitives.
  const std::string zeros = R"("accessors":[{"type":"VEC3","componentType":5126,"count":100000}],)";
  expect_gltf_error(zeros + R"("meshes":[{"primitives":[)" + list_of(R"({"attributes":{"POSITION":0}})", 20000) +
                    "]}]");
  expect_gltf_error(zeros + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[)" +
                    list_of(R"({"POSITION":0})", 20000) + "]}]}]");
  // A strip whose indices have no data: 192 M flat triangles.
  expect_gltf_error(
      R"("accessors":[{"type":"VEC3","componentType":5126,"count":1},{"type":"SCALAR","componentType":5125,"count":16000000}],
      "meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":0},"indices":1}]}])");
  // One mesh shown very often.
  expect_gltf_error(zeros + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" +
                    list_of(R"({"mesh":0})", 5000) + "]");
  // A skin with many joints on very many small meshes.
  expect_gltf_error(R"("accessors":[{"type":"VEC3","componentType":5126,"count":3}],"skins":[{"joints":[)" +
                    list_of("0", 20000) + R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[)" +
                    list_of(R"({"mesh":0,"skin":0})", 20000) + "]");
}

// What is wrong with a channel is found when the file is loaded, not when it is played.
TEST_F(Hostile, Animations) {
  GltfBuilder builder;
  const auto n = [](int value) { return std::to_string(value); };
  const std::string position = n(builder.vec3(std::vector<float>(9, 0.0f)));
  const std::string two = n(builder.floats("SCALAR", 1, {0, 1}));
  const std::string three = n(builder.floats("SCALAR", 1, {0, 0, 0}));
  const std::string falling = n(builder.floats("SCALAR", 1, {1, 0}));
  const std::string never = n(builder.floats("SCALAR", 1, {0, std::numeric_limits<float>::quiet_NaN()}));
  const std::string none = n(builder.accessor(R"("componentType":5126,"type":"SCALAR","count":0)"));
  const std::string moves = n(builder.vec3({0, 0, 0, 1, 0, 0}));
  const auto error_of = [&](const std::string& path, const std::string& input, const std::string& output,
                            const std::string& more = "") {
    return folder_.error(
        "a.gltf",
        builder.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + position +
                     R"(},"targets":[{"POSITION":)" + position + R"(},{}]}]}],"animations":[{"channels":[
        {"sampler":0,"target":{"node":0,"path":")" +
                     path + R"("}}],"samplers":[{"input":)" + input + R"(,"output":)" + output + more + "}]}]"));
  };
  EXPECT_EQ(error_of("translation", two, moves), "");
  EXPECT_EQ(error_of("weights", n(builder.floats("SCALAR", 1, {7})), two), "");
  EXPECT_NE(error_of("weights", two, three).find("3 numbers, where its 2 keys need 4"), std::string::npos);
  EXPECT_NE(error_of("rotation", two, moves).find("6 numbers, where its 2 keys need 8"), std::string::npos);
  EXPECT_NE(error_of("scale", two, moves, R"(,"interpolation":"CUBICSPLINE")").find("need 18"), std::string::npos);
  EXPECT_EQ(error_of("translation", falling, moves), "");
  EXPECT_EQ(error_of("translation", never, moves), "");
  EXPECT_NE(error_of("translation", none, none), "");
  EXPECT_NE(error_of("translation", moves, moves), "");
  EXPECT_NE(error_of("translation", two, moves, R"(,"interpolation":"BEZIER")"), "");
  EXPECT_NE(error_of("translation", two, "99"), "");
}

TEST_F(Hostile, LongChainsOfNodesAreNotTrouble) {
  std::string nodes;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) nodes += i + 1 < kCount ? "{\"children\":[" + std::to_string(i + 1) + "]}," : "{}";
  EXPECT_EQ(folder_.error("a.gltf", gltf_of("\"nodes\":[" + nodes + "]")), "");
}

// A warning that names the file, and no such texture.
TEST_F(Hostile, DamagedTextures) {
  Image pixel(1, 1);
  save_png(folder_.path("p.png"), pixel);
  std::ifstream file(folder_.path("p.png"), std::ios::binary);
  const std::string png((std::istreambuf_iterator<char>(file)), {});
  std::string wide = png;
  wide.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff"));
  std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\4\0\4\0\x18\0", 18);
  tga += std::string(47, '\x40');  // of 4 x 4 x 3 bytes
  const std::string jpeg("\xff\xd8\xff\xc0\x00\x0b\x08\x00\x10\x00\x10\x01\x01\x11\x00\xff\xd9", 17);
  folder_.write("m.mtl", "newmtl m\nmap_Kd q.png\n");
  for (const std::string& content : {wide, png.substr(0, 40), png.substr(0, 8), tga, jpeg, std::string("GIF89a"),
                                     std::string(1000, '\xff'), std::string("DDS |"), std::string("<html>")}) {
    folder_.write("q.png", content);
    const WarningCapture capture;
    const Scene gltf = folder_.load(
        "a.gltf",
        gltf_of(
            R"("images":[{"uri":"q.png"}],"textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}])"));
    const Scene obj = folder_.load("a.obj", "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(gltf.textures.size() + obj.textures.size(), 0u);
    EXPECT_EQ(gltf.materials.at(0).emission_texture.texture, -1);
    EXPECT_EQ(obj.materials.at(0).base_color_texture.texture, -1);
    ASSERT_EQ(capture.warnings().size(), 2u);
    for (const std::string& warning : capture.warnings())
      EXPECT_TRUE(warning.starts_with(folder_.path("q.png: "))) << warning;
  }
}

TEST_F(Hostile, PlyPromises) {
  const std::string head = "ply\nformat binary_little_endian 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  expect_error("a.ply", head + vertex + face + std::string(12, '\0') + "\xff\xff\xff\xff");
  expect_error("a.ply", head + "element nothing 9000000000000000000\n" + vertex + face + std::string(12, '\0'));
  expect_error("a.ply", head + "element much 9000000000000000000\nproperty char c\n" + vertex + face);
  expect_error("a.ply", head + repeated("element x 1\nproperty char c\n", 100000));
  expect_error("a.ply", head + "element vertex 1\n" + repeated("property float x\n", 100000) + "end_header\n");
  expect_error("a.ply", "ply\n" + std::string(1 << 20, 'x'));
}

TEST_F(Hostile, NamesThatNoFileCanHave) {
  const std::string name = repeated("x", 5000);
  expect_error("a.obj", "mtllib " + name + "\nv 0 0 0\nf 1 1 2\n");
  folder_.write("m.mtl", "newmtl m\nmap_Kd " + name + "\n");
  EXPECT_EQ(folder_.error("a.obj", "mtllib m.mtl\nv 0 0 0\nf 1 1 1\n"), "");
  expect_gltf_error(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"count":1,
      "type":"VEC3","componentType":5126}],"bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":12,"uri":")" +
                    name + "\"}]");
  EXPECT_EQ(folder_.error("a.gltf",
                          gltf_of(R"("images":[{"uri":")" + name +
                                  R"("}],"textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}])")),
            "");
  EXPECT_THROW(load_scene(name + ".obj"), InputError);
}

TEST_F(Hostile, ObjCuriosities) {
  expect_error("a.obj", "v 0 0 0\n" + repeated("f 1 1", 1) + repeated(" 1", 1000000) + " 2\n");
  EXPECT_EQ(folder_.error("a.obj", "v 0 0 0\nf 1 1" + repeated(" 1", 1000000) + "\n"), "");
  expect_error("a.obj", repeated("\\\n", 1000000));
  expect_error("a.obj", std::string(1 << 20, '\0'));
  expect_error("a.obj", "mtllib .\n");
  expect_error("a.obj", std::string("mtllib a\0b.mtl\n", 15));
  expect_error("a.obj", "mtllib a.obj\nv 0 0 0\nf 1 1 2\n");
  expect_error("a.xyz", "");
  expect_error("none.obj/", "");
}

}  // namespace
}  // namespace lightwell
