// Small valid files of every format that is read, for random damage.
#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>

#include <map>
#include <string>
#include <vector>

#include "core/test_images.h"
#include "scene/compressed_files.h"
#include "scene/fuzz_gltf.h"

namespace lightwell::test {

// A valid file, and one that it refers to.
struct Seed {
  std::string name;
  std::string content;
  std::string companion_name = "";
  std::string companion = "";
  bool damage_companion_only = false;
};

inline std::string as_text(const File& file) {
  return {file.begin(), file.end()};
}

// Three channels of numbers.
template <typename Number>
std::string encode_exr_kind(int width, int height, Imf::PixelType type, Imf::Compression compression, bool tiled) {
  Imf::Header header(width, height, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y, compression);
  std::vector<Number> pixels(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = Number(0.25f * static_cast<float>(i % 17));
  Imf::FrameBuffer frame;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(pixels.data()), sizeof(Number),
                                  sizeof(Number) * static_cast<std::size_t>(width)));
  }
  Imf::StdOSStream stream;
  if (tiled) {
    header.setTileDescription(Imf::TileDescription(8, 8, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  return stream.str();
}

// Of 8 bits a pixel with a palette.
inline std::string palette_bmp() {
  std::string file = as_text(encode_bmp(8, 8)).substr(0, 54);
  file[2] = static_cast<char>(54 + 16 + 64);
  file[10] = 54 + 16;
  file[28] = 8;
  file[46] = 4;  // colours
  file += std::string("\1\2\3\0\4\5\6\0\7\7\7\0\1\1\1\0", 16);
  for (int i = 0; i < 64; ++i) file += static_cast<char>(i % 4);
  return file;
}

inline std::string palette_tga() {
  std::string file = as_text(encode_tga(8, 8, true)).substr(0, 18);
  file[1] = 1;
  file[2] = 9;   // runs of colours of a palette
  file[5] = 4;   // colours
  file[7] = 24;  // bits each
  file[16] = 8;
  file[17] = 0;
  file += std::string("\1\2\3\4\5\6\7\7\7\1\1\1", 12);
  for (int i = 0; i < 8; ++i) file += std::string("\x87", 1) + static_cast<char>(i % 4);
  return file;
}

using SeedsOfFormats = std::map<std::string, std::vector<Seed>>;

inline void add_gltf_seeds(SeedsOfFormats& seeds) {
  const std::string png = as_text(encode_png_kind(4, 4, std::vector<std::uint8_t>(48, 128), {}));
  std::string rest, more;
  const GltfBuilder gltf = gltf_parts(rest), quantized = more_gltf_parts(more);
  seeds["Gltf"] = {{"a.gltf", gltf.text(rest), "p.png", png},
                   {"a.gltf", quantized.text(more), "p.png", png},
                   {"a.gltf", gltf.text(rest, "b.bin"), "b.bin", gltf.data()},
                   {"a.gltf", quantized.text(more, "b.bin"), "b.bin", quantized.data()}};
  seeds["Glb"] = {{"a.glb", gltf.glb(rest), "p.png", png}, {"a.glb", quantized.glb(more), "p.png", png}};
#if LIGHTWELL_DRACO
  for (const int side : {3, 9}) {
    const DracoGrid grid(side);
    const auto text = [&](const char* uri) { return grid.text(uri, grid.data.size(), grid.count); };
    seeds["Draco"].push_back({"a.glb", glb_of(text(""), grid.data)});
    seeds["Draco"].push_back({"a.gltf", text("b.bin"), "b.bin", grid.data});
  }
#endif
#if LIGHTWELL_MESHOPT
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const MeshoptGrid grid(9, mode);
    seeds["Meshopt"].push_back({"a.glb", glb_of(grid.text(""), grid.data)});
    seeds["Meshopt"].push_back({"a.gltf", grid.text("b.bin"), "b.bin", grid.data});
  }
#endif
}

inline void add_mesh_seeds(SeedsOfFormats& seeds) {
  const std::string png = as_text(encode_png_kind(4, 4, std::vector<std::uint8_t>(48, 128), {}));
  const std::string ply_head =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string ply_body =
      raw_bytes(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}) + '\3' + raw_bytes(std::vector<int>{0, 1, 2});
  std::string swapped = ply_body;  // each number of four bytes from its other end
  for (const std::size_t at : {0, 4, 8, 12, 16, 20, 24, 28, 32, 37, 41, 45})
    std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(at),
                 swapped.begin() + static_cast<std::ptrdiff_t>(at) + 4);
  const std::string textured_head =
      "comment TextureFile p.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n"
      "property uchar red\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string textured_body =
      "0 0 0 1 2 3 255\n2 0 0 4 5 6 9\n1 2 0 7 8 9 255\n1 0.5 0 1 1 1 0\n4 0 3 1 2 8 0 0 1 0 1 1 0 1 0 7\n"
      "6 0 1 2 -1 3 2\n";
  std::string textured_bytes;
  for (int i = 0; i < 4; ++i)
    textured_bytes += raw_bytes(std::vector<float>{float(i % 2), float(i / 2), 0}) + "\1\2\3\4";
  textured_bytes += '\4' + raw_bytes(std::vector<int>{0, 1, 3, 2}) + '\10' +
                    raw_bytes(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}) + raw_bytes(std::vector<int>{0}) + '\7' +
                    raw_bytes(std::vector<int>{6, 0, 1, 2, -1, 3, 2});
  const std::string text = "ply\nformat ascii 1.0\n", little = "ply\nformat binary_little_endian 1.0\n";
  seeds["PlyText"] = {{"a.ply", text + ply_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
                      {"a.ply", text + textured_head + textured_body, "p.png", png}};
  seeds["PlyBinary"] = {{"a.ply", little + ply_head + ply_body},
                        {"a.ply", "ply\nformat binary_big_endian 1.0\n" + ply_head + swapped},
                        {"a.ply", little + textured_head + textured_bytes, "p.png", png}};

  const std::string obj =
      "# box\nmtllib m.mtl\nv 0 0 0\nv\t1 0 0 # c\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl a\n"
      "f 1/1/1 2/2/1 3/1/1 4/2/1\nusemtl b\nf -4 -3 -2\nf 1//1 2//1 \\\n3//1\n";
  const std::string mtl =
      "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd -s 2 2 -clamp on p.png\nnewmtl b\nKe 17 12 4 # lamp\nNi 1.5\n";
  const std::string colored_obj =
      "\xef\xbb\xbfmtllib m.mtl\nv 0 0 0 1 0 0\nv 2 0 0 0 1 0\nv 1 2 0 0 0 255\nv 1 0.5 0\nv 0 0 nan\nusemtl a #1\n"
      "f 1 4 2 3\nf 3/1/1 2//0 1 4 \nl 1 2\ns 1\nf 1 2 5\n";
  const std::string more_mtl =
      "newmtl a #1\nKd 1 0.5 0\nd 0.4\nTr 0.6\nmap_d -imfchan l -mm 0 1 p.png\nmap_Bump -bm 0.3 p.png\nnorm p.png\n"
      "Pr 0.2\nPm 1\nTf 1 0 1\nmap_Kd -o 1 2 -s 2 2 2 C:\\x\\p.png\n";
  seeds["Obj"] = {{"a.obj", obj, "m.mtl", mtl}, {"a.obj", colored_obj, "m.mtl", more_mtl}};
}

// As textures with and without a mask, and as light from outside.
inline void add_picture_seeds(SeedsOfFormats& seeds) {
  const auto textured = [](const std::string& material) {
    return gltf_of(R"("images":[{"uri":"p.png"}],"textures":[{"source":0}],"materials":[{)" + material + "}]");
  };
  const std::string glowing = textured(R"("emissiveTexture":{"index":0})");
  const std::string masked = textured(R"("alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}})");
  const auto add = [&](const char* format, const std::string& picture) {
    seeds[format].push_back({"a.gltf", glowing, "p.png", picture, true});
    seeds[format].push_back({"a.gltf", masked, "p.png", picture, true});
  };
  const std::vector<std::uint8_t> bytes(256, 77);
  add("Png", as_text(encode_png_kind(8, 8, bytes, {})));
  add("Png", as_text(encode_png_kind(8, 8, std::vector<std::uint8_t>(512, 9),
                                     {PNG_COLOR_TYPE_RGBA, 16, PNG_INTERLACE_ADAM7, {}})));
  add("Png", as_text(encode_png_kind(8, 8, bytes, {PNG_COLOR_TYPE_GRAY, 1, PNG_INTERLACE_NONE, {}})));
  add("Png",
      as_text(encode_png_kind(8, 8, std::vector<std::uint8_t>(32, 0x12),
                              {PNG_COLOR_TYPE_PALETTE, 4, PNG_INTERLACE_ADAM7, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}})));
  const std::string jpeg = as_text(encode_jpeg(9, 8, ramp(9, 8, 3)));
  add("Jpeg", jpeg);
  add("Jpeg", as_text(encode_jpeg(9, 8, ramp(9, 8, 3), {JCS_RGB, true})));
  add("Jpeg", as_text(encode_jpeg(9, 8, ramp(9, 8, 4), {JCS_CMYK})));
  add("Jpeg", as_text(encode_jpeg(33, 20, ramp(33, 20, 1), {JCS_GRAYSCALE})));
  seeds["Jpeg"].push_back({"a.hdr", jpeg});
  add("Bmp", as_text(encode_bmp(8, 8)));
  add("Bmp", palette_bmp());
  add("Tga", as_text(encode_tga(9, 8, false)));
  add("Tga", as_text(encode_tga(9, 8, true)));
  add("Tga", palette_tga());
  add("Webp", as_text(encode_webp(33, 20, true)));
  add("Webp", as_text(encode_webp(33, 20, false)));
  add("Gif", as_text(encode_gif(9, 8, true)));
  add("Gif", as_text(encode_gif(9, 8, false, 2, 1)));

  const std::string hdr_head = "#?RADIANCE\nGAMMA=1\nFORMAT=32-bit_rle_rgbe\n\n";
  std::string hdr_line("\2\2\0\10", 4);
  for (int channel = 0; channel < 4; ++channel) hdr_line += "\x88\x80";
  seeds["Hdr"] = {{"a.hdr", hdr_head + "-Y 2 +X 8\n" + hdr_line + hdr_line},
                  {"a.hdr", hdr_head + "-Y 2 +X 2\n" + std::string(16, '\x80')}};
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
        Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION})
    for (const bool tiled : {false, true}) {
      seeds["Exr"].push_back({"a.exr", encode_exr_kind<half>(12, 10, Imf::HALF, compression, tiled)});
      seeds["Exr"].push_back({"a.exr", encode_exr_kind<float>(12, 10, Imf::FLOAT, compression, tiled)});
    }
}

inline SeedsOfFormats make_seeds() {
  SeedsOfFormats seeds;
  add_gltf_seeds(seeds);
  add_mesh_seeds(seeds);
  add_picture_seeds(seeds);
  return seeds;
}

}  // namespace lightwell::test
