#include "scene/texture_loader.h"

#include <utility>

#include "core/log.h"
#include "lightwell/error.h"
#include "lightwell/image.h"

namespace lightwell {

namespace {

constexpr std::size_t kMaxTextures = 16384;

// A picture of one colour is honest, and deflate packs it 1032:1; beyond that only some may be.
constexpr MemoryLimit kTextureLimit = {
    .base = std::uint64_t{512} << 20, .per_input_byte = 1032, .most = std::uint64_t{4} << 30};

// Nothing, after a warning, if `read` refuses the image.
template <typename Function>
auto or_warning(Function read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const ForbiddenFile&) {
    throw;
  } catch (const InputError& error) {
    log_warning(std::string(error.what()) + ": no such texture");
    return std::nullopt;
  }
}

}  // namespace

TextureLoader::TextureLoader(Scene& scene, const std::string& subject)
    : scene_(scene), subject_(subject), budget_(subject, "textures", kTextureLimit) {}

int TextureLoader::add(const std::string& image, const std::string& name, std::span<const std::uint8_t> bytes) {
  std::optional<Texture> texture = decode(image, name, bytes);
  return texture ? append(std::move(*texture)) : -1;
}

int TextureLoader::add_file(const SceneFiles& files, const std::string& path, const std::string& name) {
  std::optional<Texture> texture = decode_file(files, path, name);
  return texture ? append(std::move(*texture)) : -1;
}

std::optional<Texture> TextureLoader::decode_file(const SceneFiles& files, const std::string& path,
                                                  const std::string& name) {
  const auto bytes = or_warning([&] { return files.read(path); });
  return bytes ? decode(path, name, *bytes) : std::nullopt;
}

int TextureLoader::append(Texture texture) {
  if (scene_.textures.size() >= kMaxTextures) throw InputError(subject_, "has more than 16384 textures");
  scene_.textures.push_back(std::move(texture));
  return static_cast<int>(scene_.textures.size()) - 1;
}

std::optional<Texture> TextureLoader::decode(const std::string& image, const std::string& name,
                                             std::span<const std::uint8_t> bytes) {
  const auto size = or_warning([&] { return image8_size(image, bytes.data(), bytes.size()); });
  if (!size) return std::nullopt;
  // What turns out to be damaged counts as well: decoding it was work.
  budget_.add_input(bytes.size());
  budget_.charge(static_cast<std::uint64_t>(size->width) * static_cast<std::uint64_t>(size->height), 4);
  auto decoded = or_warning([&] { return decode_image8(image, bytes.data(), bytes.size()); });
  if (!decoded) return std::nullopt;
  Texture texture;
  texture.name = name;
  texture.width = decoded->width;
  texture.height = decoded->height;
  texture.rgba = std::move(decoded->rgba);
  return texture;
}

}  // namespace lightwell
