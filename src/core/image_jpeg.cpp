// JPEG textures by libjpeg-turbo: baseline and progressive, gray, colour, CMYK.
#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs FILE

#include <jpeglib.h>

#include <jerror.h>

#include "core/image_formats.h"
#include "lightwell/error.h"

namespace lightwell {

namespace {

// A scan costs time in proportion to the whole picture and may hold few bytes; encoders write about ten.
constexpr int kMaxScans = 100;

// Each block of 8x8 pixels has a coefficient of its own that takes a bit at least.
constexpr std::int64_t kMaxPixelsPerByte = 8 * 64;

// libjpeg reports errors by longjmp. Each function below that sets the jump target calls libjpeg only and owns nothing;
// what must be destroyed belongs to its caller.
struct JpegErrors {
  jpeg_error_mgr manager{};  // the first member: libjpeg knows only this one
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  jpeg->err->format_message(jpeg, errors->message.data());
  std::longjmp(errors->jump, 1);
}

// libjpeg warns of damage and decodes something. Only what costs no pixel is let pass.
void on_message(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  const bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_JFIF_MAJOR || code == JWRN_ADOBE_XFORM;
  if (level < 0 && !harmless) on_error(jpeg);
}

void on_progress(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMaxScans) return;
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  std::snprintf(errors->message.data(), errors->message.size(), "more than %d scans", kMaxScans);
  std::longjmp(errors->jump, 1);
}

struct JpegReader {
  JpegReader() {
    jpeg.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = on_error;
    errors.manager.emit_message = on_message;
    progress.progress_monitor = on_progress;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  jpeg_decompress_struct jpeg{};
  jpeg_progress_mgr progress{};
  JpegErrors errors;
};

bool read_jpeg_header(JpegReader& reader, Bytes bytes) {
  if (setjmp(reader.errors.jump)) return false;
  jpeg_create_decompress(&reader.jpeg);
  reader.jpeg.progress = &reader.progress;
  jpeg_mem_src(&reader.jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&reader.jpeg, TRUE);
  return true;
}

// Four bytes a pixel: RGBA, or CMYK where that is what the file has.
bool read_jpeg_rows(JpegReader& reader, unsigned char* rows, std::size_t row_bytes) {
  jpeg_decompress_struct& jpeg = reader.jpeg;
  if (setjmp(reader.errors.jump)) return false;
  const bool four_inks = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
  jpeg.out_color_space = four_inks ? JCS_CMYK : JCS_EXT_RGBA;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = rows + jpeg.output_scanline * row_bytes;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

// What is left of white light behind the inks: (1 - C)(1 - K). Adobe's files store 1 - C.
void rgba_from_cmyk(std::vector<unsigned char>& pixels, bool inverted) {
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const auto light = [&](std::size_t ink) { return inverted ? pixels[i + ink] : 255 - pixels[i + ink]; };
    const int black = light(3);
    for (std::size_t c = 0; c < 3; ++c) pixels[i + c] = static_cast<unsigned char>((light(c) * black + 127) / 255);
    pixels[i + 3] = 255;
  }
}

[[noreturn]] void fail(const std::string& subject, const JpegReader& reader) {
  throw InputError(subject, std::string("damaged JPEG file: ") + reader.errors.message.data());
}

ImageSize open_jpeg(const std::string& subject, JpegReader& reader, Bytes bytes) {
  if (!read_jpeg_header(reader, bytes)) fail(subject, reader);
  check_image_size(subject, reader.jpeg.image_width, reader.jpeg.image_height, bytes.size(), kMaxPixelsPerByte);
  return {static_cast<int>(reader.jpeg.image_width), static_cast<int>(reader.jpeg.image_height)};
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

ImageSize jpeg_size(const std::string& subject, Bytes bytes) {
  JpegReader reader;
  return open_jpeg(subject, reader, bytes);
}

Image8 decode_jpeg8(const std::string& subject, Bytes bytes) {
  JpegReader reader;
  const ImageSize size = open_jpeg(subject, reader, bytes);
  const std::size_t row_bytes = static_cast<std::size_t>(size.width) * 4;
  Image8 image{size.width, size.height, std::vector<unsigned char>(row_bytes * static_cast<std::size_t>(size.height))};
  if (!read_jpeg_rows(reader, image.rgba.data(), row_bytes)) fail(subject, reader);
  if (reader.jpeg.out_color_space == JCS_CMYK) rgba_from_cmyk(image.rgba, reader.jpeg.saw_Adobe_marker != FALSE);
  return image;
}

}  // namespace lightwell
