// Which files a scene may read.
#include "scene/scene_files.h"

#include <sys/stat.h>

#include <chrono>

#include <gtest/gtest.h>

#include "core/log.h"
#include "scene/test_files.h"

namespace lightwell {
namespace {

using namespace test;
namespace fs = std::filesystem;

// "in/" is the folder that a stranger sent; "secret.*" beside it is none of his business.
class SceneFilesTest : public testing::Test {
 protected:
  SceneFilesTest() {
    fs::create_directories(folder_.path("in/maps"));
    folder_.write("secret.bin", std::string(36, '\0'));
    folder_.write("secret.mtl", "newmtl m\n");
    Image pixel(1, 1);
    save_png(folder_.path("secret.png"), pixel);
    save_png(folder_.path("in/own.png"), pixel);
    folder_.write("in/own.bin", std::string(36, '\0'));
    folder_.write("in/own.mtl", "newmtl m\n");
    confined_.root = folder_.path("in");
    set_log_level(LogLevel::kQuiet);
  }
  ~SceneFilesTest() override { set_log_level(LogLevel::kWarning); }

  static std::string with_buffer(const std::string& uri) {
    return gltf_of(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{
        "bufferView":0,"count":3,"type":"VEC3","componentType":5126}],"bufferViews":[{"buffer":0,"byteLength":36}],
        "buffers":[{"byteLength":36,"uri":")" +
                   uri + "\"}]");
  }
  static std::string with_image(const std::string& uri) {
    return gltf_of(R"("textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}],"images":[{"uri":")" +
                   uri + "\"}]");
  }
  std::string with_map(const std::string& name) const {
    folder_.write("in/map.mtl", "newmtl m\nmap_Kd " + name + "\n");
    return with_library("map.mtl");
  }
  std::string read_text(const std::string& name) const {
    std::ifstream file(folder_.path(name), std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
  }
  static std::string with_library(const std::string& name) {
    return "mtllib " + name + "\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  }

  // The message with which loading in/NAME fails; empty if it does not.
  std::string error(const std::string& name, const std::string& content, const ImportOptions& options) const {
    try {
      load_scene(folder_.write("in/" + name, content), options);
    } catch (const InputError& refused) {
      return refused.what();
    }
    return "";
  }

  // Every kind of reference, to the file of the right kind among PREFIX.bin, .png, .mtl.
  void expect_refused_when_confined(const std::string& prefix) const {
    const std::vector<std::pair<std::string, std::string>> scenes = {{"a.gltf", with_buffer(prefix + ".bin")},
                                                                     {"a.gltf", with_image(prefix + ".png")},
                                                                     {"a.obj", with_library(prefix + ".mtl")},
                                                                     {"a.obj", with_map(prefix + ".png")}};
    for (const auto& [name, content] : scenes) {
      EXPECT_EQ(error(name, content, {}), "") << content;
      EXPECT_NE(error(name, content, confined_).find("lies outside of"), std::string::npos) << content;
    }
  }

  TempFolder folder_;
  ImportOptions confined_;
};

TEST_F(SceneFilesTest, ClimbingPathsAreAllowedUnlessConfined) {
  expect_refused_when_confined("../secret");
}

TEST_F(SceneFilesTest, AbsolutePathsAreAllowedUnlessConfined) {
  expect_refused_when_confined(folder_.path("secret"));
}

TEST_F(SceneFilesTest, SymbolicLinksAreFollowedBeforeTheRootIsCompared) {
  for (const char* extension : {".bin", ".png", ".mtl"})
    fs::create_symlink(std::string("../secret") + extension, folder_.path(std::string("in/link") + extension));
  expect_refused_when_confined("link");
  fs::create_directory_symlink("..", folder_.path("in/up"));
  expect_refused_when_confined("up/secret");
}

TEST_F(SceneFilesTest, WhatLiesInTheRootIsRead) {
  fs::create_symlink("own.png", folder_.path("in/link.png"));
  for (const std::string& uri : {std::string("own.bin"), std::string("maps/../own.bin"), folder_.path("in/own.bin")})
    EXPECT_EQ(error("a.gltf", with_buffer(uri), confined_), "") << uri;
  EXPECT_EQ(error("a.gltf", with_image("maps/../link.png"), confined_), "");
  EXPECT_EQ(error("a.gltf", with_image("none.png"), confined_), "");  // missing textures are warnings as ever
  EXPECT_EQ(error("a.obj", with_library("own.mtl"), confined_), "");
  EXPECT_EQ(error("a.obj", with_map("own.png"), confined_), "");
  confined_.root = "/";
  EXPECT_EQ(error("a.gltf", with_buffer("../secret.bin"), confined_), "");
}

// Paths of other machines: the last part, where it lies beside the file.
TEST_F(SceneFilesTest, ImagesOfOtherMachinesAreLookedForBesideTheFile) {
  for (const char* path : {"/home/someone/own.png", "C:\\\\textures\\\\own.png", "../nowhere/own.png",
                           "file:///x/own.png", "https://example.org/a/own.png?size=2", "C:/textures/own.png"}) {
    for (const ImportOptions& options : {ImportOptions{}, confined_}) {
      set_log_level(LogLevel::kWarning);
      const WarningCapture capture;
      const std::string mtl_path = std::string(path).find("\\\\") == std::string::npos ? path : "C:\\textures\\own.png";
      const Scene gltf = load_scene(folder_.write("in/a.gltf", with_image(path)), options);
      const Scene obj = load_scene(folder_.write("in/a.obj", with_map(mtl_path)), options);
      EXPECT_EQ(gltf.textures.size(), 1u) << path;
      EXPECT_EQ(obj.textures.size(), 1u) << path;
      ASSERT_EQ(capture.warnings().size(), 2u) << path;
      for (const std::string& warning : capture.warnings())
        EXPECT_TRUE(warning.starts_with(folder_.path("in/own.png: taken for "))) << warning;
    }
  }
  const WarningCapture capture;
  load_scene(folder_.write("in/a.gltf", with_image("maps\\\\..\\\\own.png")));
  EXPECT_EQ(capture.warnings().size(), 0u);
}

// What cannot be had is a warning that names it, and the scene shows.
TEST_F(SceneFilesTest, ImagesThatCannotBeReadAreLeftOut) {
  folder_.write("in/empty.png", "");
  folder_.write("in/cut.png", read_text("in/own.png").substr(0, 40));
  for (const char* uri :
       {"none.png", "https://example.org/none.png", "empty.png", "cut.png", "data:image/png;base64,!!",
        "data:image/png,abc", "/none.png", "a%00b.png", "C:\\\\none.png"}) {
    const WarningCapture capture;
    const Scene scene = load_scene(folder_.write("in/a.gltf", with_image(uri)));
    EXPECT_EQ(scene.textures.size(), 0u) << uri;
    EXPECT_EQ(capture.warnings().size(), 1u) << uri;
  }
  const WarningCapture capture;
  load_scene(folder_.write("in/a.gltf", with_image("empty.png")));
  EXPECT_NE(capture.warnings().at(0).find("empty file"), std::string::npos);
}

TEST_F(SceneFilesTest, TheSceneItselfLiesInTheRoot) {
  folder_.write("in-side.obj", with_library("none"));  // not below "in", though its name begins so
  EXPECT_THROW(load_scene(folder_.path("in-side.obj"), confined_), InputError);
  EXPECT_NO_THROW(load_scene(folder_.path("in-side.obj")));
  confined_.root = folder_.path("nowhere");
  EXPECT_NE(error("a.gltf", with_image("own.png"), confined_).find("ImportOptions::root"), std::string::npos);
}

// Whoever waited for a FIFO's other end would wait for ever.
TEST_F(SceneFilesTest, OnlyRegularFilesAreRead) {
  ASSERT_EQ(::mkfifo(folder_.path("in/fifo").c_str(), 0600), 0);
  for (const char* name : {"fifo", "/dev/zero", "/dev/tty", "maps"}) {
    for (const auto& [file, content] : {std::pair{"a.gltf", with_buffer(name)}, std::pair{"a.gltf", with_image(name)},
                                        std::pair{"a.obj", with_library(name)}, std::pair{"a.obj", with_map(name)}})
      EXPECT_NE(error(file, content, {}).find("not a regular file"), std::string::npos) << content;
  }
}

}  // namespace
}  // namespace lightwell
