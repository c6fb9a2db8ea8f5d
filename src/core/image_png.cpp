#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>

#include "core/color.h"
#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// libpng reports errors by longjmp. Each function below that sets the jump target calls libpng only and owns nothing;
// what must be destroyed belongs to its caller.
struct PngState {
  Bytes input;
  std::size_t position = 0;
  std::vector<std::uint8_t> output;
  std::array<char, 256> message{};
};

void on_error(png_structp png, png_const_charp text) {
  auto* state = static_cast<PngState*>(png_get_error_ptr(png));
  std::strncpy(state->message.data(), text, state->message.size() - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep out, png_size_t count) {
  auto* state = static_cast<PngState*>(png_get_io_ptr(png));
  if (count > state->input.size() - state->position) png_error(png, "unexpected end of file");
  std::memcpy(out, state->input.data() + state->position, count);
  state->position += count;
}

void on_write(png_structp png, png_bytep data, png_size_t count) {
  auto* state = static_cast<PngState*>(png_get_io_ptr(png));
  bool out_of_memory = false;
  try {
    state->output.insert(state->output.end(), data, data + count);
  } catch (const std::bad_alloc&) {
    out_of_memory = true;
  }
  if (out_of_memory) png_error(png, "out of memory");
}

void on_flush(png_structp) {}

// Owns libpng's two structures for reading.
struct PngReader {
  explicit PngReader(PngState& state)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning)),
        info(png ? png_create_info_struct(png) : nullptr) {}
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  png_structp png;
  png_infop info;
};

bool read_png_header(PngReader& reader, PngState& state) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);  // check_image_size() has the better message
  png_set_read_fn(reader.png, &state, on_read);
  png_read_info(reader.png, reader.info);
  return true;
}

// Asks for RGBA, whatever the file's colour type: 8 bits a channel, or 16 if the file has them and they are wanted.
bool choose_png_format(PngReader& reader, bool keep_16_bits) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  if (!keep_16_bits) png_set_scale_16(reader.png);
  png_set_expand(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_add_alpha(reader.png, 0xffff, PNG_FILLER_AFTER);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_png_rows(PngReader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

[[noreturn]] void fail(const std::string& subject, const PngState& state) {
  throw InputError(subject, std::string("damaged PNG file: ") + state.message.data());
}

ImageSize open_png(const std::string& subject, PngReader& reader, PngState& state) {
  if (!reader.info) throw InputError(subject, "libpng could not be started");
  if (!read_png_header(reader, state)) fail(subject, state);
  const std::uint32_t width = png_get_image_width(reader.png, reader.info);
  const std::uint32_t height = png_get_image_height(reader.png, reader.info);
  check_image_size(subject, width, height, state.input.size());
  return {static_cast<int>(width), static_cast<int>(height)};
}

struct Samples {
  ImageSize size;
  int bytes_per_sample = 1;  // 2: big endian
  std::vector<std::uint8_t> rgba;
};

Samples read_samples(const std::string& subject, Bytes bytes, bool keep_16_bits) {
  PngState state;
  state.input = bytes;
  PngReader reader(state);
  Samples samples;
  samples.size = open_png(subject, reader, state);
  if (!choose_png_format(reader, keep_16_bits)) fail(subject, state);
  samples.bytes_per_sample = png_get_bit_depth(reader.png, reader.info) == 16 ? 2 : 1;
  const std::size_t row_bytes =
      static_cast<std::size_t>(samples.size.width) * 4 * static_cast<std::size_t>(samples.bytes_per_sample);
  if (png_get_rowbytes(reader.png, reader.info) != row_bytes) throw InputError(subject, "unexpected PNG row size");
  samples.rgba.resize(row_bytes * static_cast<std::size_t>(samples.size.height));
  std::vector<png_bytep> rows(static_cast<std::size_t>(samples.size.height));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = samples.rgba.data() + y * row_bytes;
  if (!read_png_rows(reader, rows.data())) fail(subject, state);
  return samples;
}

bool write_png(png_structp png, png_infop info, PngState& state, int width, int height, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &state, on_write, on_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, info);
  return true;
}

}  // namespace

bool is_png(Bytes bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

Image decode_png(const std::string& subject, Bytes bytes) {
  const Samples samples = read_samples(subject, bytes, true);
  const bool wide = samples.bytes_per_sample == 2;
  std::vector<float> linear(wide ? 65536 : 256);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / static_cast<double>(linear.size() - 1)));

  Image image(samples.size.width, samples.size.height, 3);
  const std::size_t count = image.pixels.size() / 3;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t s = i * 4 + c;
      const std::size_t value = wide ? static_cast<std::size_t>(samples.rgba[2 * s] << 8 | samples.rgba[2 * s + 1])
                                     : static_cast<std::size_t>(samples.rgba[s]);
      image.pixels[i * 3 + c] = linear[value];
    }
  return image;
}

ImageSize png_size(const std::string& subject, Bytes bytes) {
  PngState state;
  state.input = bytes;
  PngReader reader(state);
  return open_png(subject, reader, state);
}

Image8 decode_png8(const std::string& subject, Bytes bytes) {
  Samples samples = read_samples(subject, bytes, false);
  return {samples.size.width, samples.size.height, std::move(samples.rgba)};
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  LW_ASSERT(image.channels == 1 || image.channels == 3, std::to_string(image.channels) + " channels");
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * 3;
  std::vector<std::uint8_t> rgb(row_bytes * static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float value = image.pixels[image.channels == 3 ? i : i / 3];
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;  // NaN is black
    rgb[i] = static_cast<std::uint8_t>(std::lround(clamped * 255.0f));
  }
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = rgb.data() + y * row_bytes;

  PngState state;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool written = info && write_png(png, info, state, image.width, image.height, rows.data());
  png_destroy_write_struct(&png, &info);
  if (!written) throw InputError("PNG", std::string("could not be encoded: ") + state.message.data());
  return std::move(state.output);
}

}  // namespace lightwell
