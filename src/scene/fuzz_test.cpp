// Random damage to small valid files: loading them succeeds or throws InputError, nothing else.
//
// LIGHTWELL_FUZZ_SECONDS (default 3) sets the budget, LIGHTWELL_FUZZ_SEED (default 1) the sequence. If the process
// dies, the file that did it stays in the folder that was printed.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "core/log.h"
#include "core/test_images.h"
#include "lightwell/metrics.h"
#include "scene/light_spec.h"
#include "scene/pose.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;

// A valid file, and one that it refers to.
struct Seed {
  std::string name;
  std::string content;
  std::string companion_name;
  std::string companion;
};

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  std::string mutate(std::string content) {
    for (std::size_t steps = 1 + below(6) / 4; steps > 0; --steps) mutate_once(content);
    return content;
  }

 private:
  void mutate_once(std::string& content) {
    if (content.empty()) return;
    switch (below(10)) {
      case 0:
        content.resize(below(content.size()));
        break;
      case 1:
        for (std::size_t n = 1 + below(8); n > 0; --n)
          content[below(content.size())] ^= static_cast<char>(1 << below(8));
        break;
      case 2:
        overwrite_word(content);
        break;
      case 3: {
        const std::string chunk = some_chunk(content);
        content.insert(below(content.size()), chunk);
        break;
      }
      case 4: {
        const std::size_t at = below(content.size());
        content.erase(at, 1 + below(32));
        break;
      }
      case 5:
      case 6:
      case 7:
        if (content.starts_with('{')) return replace_json_value(content);
        [[fallthrough]];
      default:
        replace_number(content);
    }
  }

  std::string some_chunk(const std::string& content) { return content.substr(below(content.size()), 1 + below(64)); }

  // Of JSON: a number outside of strings, where base64 has none, becomes another or something else.
  void replace_json_value(std::string& content) {
    constexpr const char* kValues[] = {"0",    "-1",   "1e-7",  "0.99999994", "1.0000001",  "-0.0",
                                       "1e38", "1e39", "1e400", "-1e38",      "4294967295", "18446744073709551616",
                                       "0.5",  "2",    "3",     "255",        "65536",      "5120",
                                       "5121", "5122", "5123",  "5125",       "5126",       "null",
                                       "true", "[]",   "{}",    "\"x\"",      "[1,2]"};
    std::vector<std::pair<std::size_t, std::size_t>> numbers;  // first and end
    bool in_string = false;
    for (std::size_t i = 0; i < content.size(); ++i) {
      if (content[i] == '"' && (i == 0 || content[i - 1] != '\\')) in_string = !in_string;
      if (in_string || std::string_view("-0123456789").find(content[i]) == std::string_view::npos) continue;
      const std::size_t end = std::min(content.find_first_not_of("+-.eE0123456789", i), content.size());
      numbers.emplace_back(i, end);
      i = end - 1;
    }
    if (numbers.empty()) return;
    const auto [first, end] = numbers[below(numbers.size())];
    const std::string old = content.substr(first, end - first);
    switch (below(4)) {
      case 0:
        return void(content.replace(first, end - first, std::to_string(std::atof(old.c_str()) + 1.0)));
      case 1:
        return void(content.replace(first, end - first, old[0] == '-' ? old.substr(1) : "-" + old));
      default:
        content.replace(first, end - first, kValues[below(std::size(kValues))]);
    }
  }

  // A number written in digits becomes one that is likely to be trouble.
  void replace_number(std::string& content) {
    constexpr const char* kNumbers[] = {"0",
                                        "-1",
                                        "1",
                                        "2",
                                        "3",
                                        "255",
                                        "65535",
                                        "2147483647",
                                        "2147483648",
                                        "4294967295",
                                        "9007199254740993",
                                        "18446744073709551616",
                                        "-9223372036854775808",
                                        "0.5",
                                        "1e38",
                                        "1e39",
                                        "-1e-45",
                                        "1e400",
                                        "nan",
                                        "inf",
                                        "5126",
                                        "5123",
                                        "5121",
                                        "1000000",
                                        ""};
    const std::size_t first = content.find_first_of("0123456789", below(content.size()));
    if (first == std::string::npos) return;
    const std::size_t end = std::min(content.find_first_not_of("0123456789.", first), content.size());
    content.replace(first, end - first, kNumbers[below(std::size(kNumbers))]);
  }

  void overwrite_word(std::string& content) {
    constexpr std::uint32_t kWords[] = {0,          1,          0x7fffffff, 0x80000000, 0xffffffff,
                                        0x7fc00000, 0x7f800000, 0xffff,     0x01000000};
    const std::uint32_t word = kWords[below(std::size(kWords))];
    const std::size_t width = std::size_t{1} << below(3);
    const std::size_t at = below(content.size());
    content.replace(at, std::min(width, content.size() - at), reinterpret_cast<const char*>(&word), width);
  }

  std::mt19937_64 random_;
};

// Everything that the glTF importer reads, in one small file.
GltfBuilder gltf_parts(std::string& rest) {
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

std::string as_text(const test::File& file) {
  return {file.begin(), file.end()};
}

std::vector<Seed> make_seeds(const TempFolder& folder) {
  Image picture(4, 4);
  picture.pixels.assign(picture.pixels.size(), 0.5f);
  save_png(folder.path("p.png"), picture);
  save_exr(folder.path("p.exr"), picture);
  const auto read = [&](const char* name) {
    std::ifstream file(folder.path(name), std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
  };
  const std::string png = read("p.png");
  std::string rest;
  const GltfBuilder gltf = gltf_parts(rest);
  const std::string ply_head =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string ply_body =
      raw_bytes(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) + '\3' + raw_bytes(std::vector<int>{0, 1, 2});
  const std::string hdr_head = "#?RADIANCE\nGAMMA=1\nFORMAT=32-bit_rle_rgbe\n\n";
  std::string hdr_line("\2\2\0\10", 4);
  for (int channel = 0; channel < 4; ++channel) hdr_line += "\x88\x80";
  const std::string obj =
      "# box\nmtllib m.mtl\nv 0 0 0\nv\t1 0 0 # c\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl a\n"
      "f 1/1/1 2/2/1 3/1/1 4/2/1\nusemtl b\nf -4 -3 -2\nf 1//1 2//1 \\\n3//1\n";
  const std::string mtl =
      "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd -s 2 2 -clamp on p.png\nnewmtl b\nKe 17 12 4 # lamp\nNi 1.5\n";
  const std::string colored_obj =
      "\xef\xbb\xbfmtllib m.mtl\nv 0 0 0 1 0 0\nv 2 0 0 0 1 0\nv 1 2 0 0 0 255\nv 1 0.5 0\nv 0 0 nan\nusemtl a #1\nf 1 "
      "4 2 3\n"
      "f 3/1/1 2//0 1 4 \nl 1 2\ns 1\nf 1 2 5\n";
  const std::string more_mtl =
      "newmtl a #1\nKd 1 0.5 0\nd 0.4\nTr 0.6\nmap_d -imfchan l -mm 0 1 p.png\nmap_Bump -bm 0.3 p.png\nnorm p.png\n"
      "Pr 0.2\nPm 1\nTf 1 0 1\nmap_Kd -o 1 2 -s 2 2 2 C:\\x\\p.png\n";
  const std::string textured_ply =
      "ply\nformat ascii 1.0\ncomment TextureFile p.png\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float "
      "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face "
      "1\nproperty list uchar "
      "int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\nproperty uchar red\nelement "
      "tristrips "
      "1\nproperty list int int vertex_indices\nend_header\n0 0 0 1 2 3 255\n2 0 0 4 5 6 9\n1 2 0 7 8 9 255\n1 0.5 0 1 "
      "1 1 0\n"
      "4 0 3 1 2 8 0 0 1 0 1 1 0 1 0 7\n6 0 1 2 -1 3 2\n";
  const std::string textured =
      gltf_of(R"("images":[{"uri":"p.png"}],"textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}])");
  return {{"a.gltf", gltf.text(rest), "p.png", png},
          {"b.gltf", gltf.text(rest, "b.bin"), "b.bin", gltf.data()},
          {"c.glb", gltf.glb(rest), "p.png", png},
          {"d.obj", obj, "m.mtl", mtl},
          {"j.obj", colored_obj, "m.mtl", more_mtl},
          {"k.ply", textured_ply, "p.png", png},
          {"l.gltf", textured, "p.png", as_text(test::encode_jpeg(9, 8, test::ramp(9, 8, 3)))},
          {"m.gltf", textured, "p.png", as_text(test::encode_jpeg(9, 8, test::ramp(9, 8, 3), {JCS_RGB, true}))},
          {"n.gltf", textured, "p.png", as_text(test::encode_webp(9, 8, true))},
          {"o.gltf", textured, "p.png", as_text(test::encode_webp(9, 8, false))},
          {"p.gltf", textured, "p.png", as_text(test::encode_gif(9, 8, true))},
          {"q.gltf", textured, "p.png", as_text(test::encode_tga(9, 8, true))},
          {"r.gltf", textured, "p.png", as_text(test::encode_bmp(8, 8))},
          {"s.hdr", as_text(test::encode_jpeg(9, 8, test::ramp(9, 8, 3))), "", ""},
          {"e.ply", "ply\nformat ascii 1.0\n" + ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "", ""},
          {"f.ply", "ply\nformat binary_little_endian 1.0\n" + ply_head + ply_body, "", ""},
          {"g.hdr", hdr_head + "-Y 2 +X 8\n" + hdr_line + hdr_line, "", ""},
          {"h.hdr", hdr_head + "-Y 2 +X 2\n" + std::string(16, '\x80'), "", ""},
          {"i.exr", read("p.exr"), "", ""}};
}

// Whatever a valid scene's animations do, its vertices come out somewhere near or are refused.
void play(const Scene& scene) {
  for (const Animation& animation : scene.animations)
    for (const float seconds : {-1.0f, 0.25f, 0.5f * animation_end(animation), 1e30f}) {
      const SceneSnapshot snapshot = take_snapshot(scene, animate_nodes(scene, animation, seconds));
      try {
        validate(snapshot, "pose");
      } catch (const InputError&) {
        continue;
      }
      for (const MeshInstance& instance : snapshot.instances)
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
          for (const glm::vec3& p : pose_primitive(primitive, instance).positions)
            ASSERT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), kMaxCoordinate);
    }
}

// True if the file loaded.
bool load(const std::string& path) {
  try {
    if (path.ends_with(".hdr") || path.ends_with(".exr")) {
      Scene scene;
      scene.environment = parse_environment(path);
      validate(scene, path);
    } else {
      play(load_scene(path));
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  } catch (const std::exception& error) {
    ADD_FAILURE() << path << ": not an InputError: " << error.what();
  }
  return false;
}

double number_from_environment(const char* name, double fallback) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : fallback;
}

TEST(Fuzz, DamagedFilesAreErrorsAndNothingWorse) {
  const TempFolder folder;
  const std::vector<Seed> seeds = make_seeds(folder);
  set_log_level(LogLevel::kQuiet);
  for (const Seed& seed : seeds) {
    folder.write(seed.name, seed.content);
    if (!seed.companion_name.empty()) folder.write(seed.companion_name, seed.companion);
    EXPECT_TRUE(load(folder.path(seed.name))) << seed.name << " is a valid file";
  }

  const double seconds = number_from_environment("LIGHTWELL_FUZZ_SECONDS", 3.0);
  const auto sequence = static_cast<std::uint64_t>(number_from_environment("LIGHTWELL_FUZZ_SEED", 1.0));
  std::cout << "seed " << sequence << ", " << seconds << " s, files in " << folder.path("") << std::endl;
  Mutator mutator(sequence);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  long cases = 0, loaded = 0;
  for (; elapsed() < seconds && !testing::Test::HasFailure(); ++cases) {
    const Seed& seed = seeds[mutator.below(seeds.size())];
    const bool damage_companion = !seed.companion_name.empty() && mutator.below(3) == 0;
    folder.write(seed.name, damage_companion ? seed.content : mutator.mutate(seed.content));
    if (!seed.companion_name.empty())
      folder.write(seed.companion_name, damage_companion ? mutator.mutate(seed.companion) : seed.companion);
    const double before = elapsed();
    loaded += load(folder.path(seed.name));
    EXPECT_LT(elapsed() - before, 20.0) << "case " << cases << " of seed " << sequence << ", " << seed.name;
  }
  set_log_level(LogLevel::kWarning);
  std::cout << cases << " files, of which " << loaded << " loaded" << std::endl;
  EXPECT_GT(cases, 10);
}

}  // namespace
}  // namespace lightwell
