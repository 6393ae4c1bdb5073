// PNG by libpng, JPEG by libjpeg-turbo, whole files in memory.
#include "app/render/list/image.h"

#include <png.h>
#include <turbojpeg.h>
#include <unistd.h>

#include <csetjmp>
#include <memory>
#include <stdexcept>
#include <utility>

#include "collision/sandbox/isolated_parser.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

constexpr int kCompressionLevel = 3;  // level 6 takes several times as long

[[noreturn]] void fail(const std::string& problem, const std::string& fix) {
  throw InputError({Diagnostic{"", 0, "picture", problem, fix, "picture.write"}});
}

bool is_consistent(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(image.height);
}

void check(const Image& image) {
  if (!is_consistent(image))
    fail("has " + std::to_string(image.rgba.size()) + " bytes for " + std::to_string(image.width) +
             " x " + std::to_string(image.height) + " pixels",
         "give 4 bytes for each pixel and at least one pixel");
}

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] != 255) return false;
  return true;
}

// libpng reports errors by longjmp.
struct PngWriter {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;

  PngWriter() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
};

void append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void flush(png_structp) {}

// No objects with destructors between setjmp and the last call of libpng.
bool encode(PngWriter& writer, const Image& image, bool opaque) {
  if (writer.png == nullptr || writer.info == nullptr) return false;
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, &writer.bytes, append, flush);
  png_set_compression_level(writer.png, kCompressionLevel);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8,
               opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(writer.png, writer.info);
  if (opaque) png_set_filler(writer.png, 0, PNG_FILLER_AFTER);  // drops the fourth byte
  for (int y = 0; y < image.height; ++y) png_write_row(writer.png, image.pixel(0, y));
  png_write_end(writer.png, writer.info);
  return true;
}

constexpr int kMaxPixels = 1 << 26;  // 8192 x 8192
constexpr int kMaxSide = 1 << 14;    // of a texture, in Mesa

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
  throw InputError(
      {Diagnostic{name, 0, "picture", problem, "save it again as PNG or JPEG", "picture.read"}});
}

Image sized(const std::string& name, std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide ||
      width * height > kMaxPixels)
    refuse(name, "has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, must have 1 to 67 million, at most 16384 along a side");
  return make_image(static_cast<int>(width), static_cast<int>(height));
}

Image decode_png(const std::string& name, std::string_view bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&png, png_image_free);
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
    refuse(name, std::string("is not a PNG: ") + png.message);
  png.format = PNG_FORMAT_RGBA;
  Image image = sized(name, png.width, png.height);
  if (!png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr))
    refuse(name, std::string("is broken: ") + png.message);
  return image;
}

Image decode_jpeg(const std::string& name, std::string_view bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitDecompress(), tjDestroy);
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colors = 0;
  if (!jpeg || tjDecompressHeader3(jpeg.get(), data, bytes.size(), &width, &height, &subsampling,
                                   &colors) != 0)
    refuse(name, "is not a JPEG");
  Image image = sized(name, width, height);
  if (tjDecompress2(jpeg.get(), data, bytes.size(), image.rgba.data(), width, 0, height, TJPF_RGBA,
                    TJFLAG_STOPONWARNING) != 0)
    refuse(name, std::string("is broken: ") + tjGetErrorStr2(jpeg.get()));
  return image;
}

Image decode(const std::string& name, const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return decode_png(name, bytes);
  if (bytes.starts_with("\xff\xd8")) return decode_jpeg(name, bytes);
  refuse(name, "is neither a PNG nor a JPEG");
}

}  // namespace

void serialize(StateArchive& archive, Image& image) {
  archive.visit(image.width, image.height, image.rgba);
  if (!is_consistent(image)) throw std::runtime_error("not a packed image");
}

Image make_image(int width, int height, std::uint8_t byte) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {width, height, std::vector<std::uint8_t>(4 * pixels, byte)};
}

std::string encode_png(const Image& image) {
  check(image);
  PngWriter writer;
  if (!encode(writer, image, is_opaque(image)))
    fail("libpng could not encode it", "use a smaller picture or free memory");
  return std::move(writer.bytes);
}

void write_png(const std::string& path, const Image& image) {
  write_whole_file(path, encode_png(image));
}

Image decode_image(const std::string& name, std::string_view bytes) {
  return parse<decode>(name, std::string(bytes));
}

Image read_image(const std::filesystem::path& file) {
  return decode_image(file.string(), read_bounded_file(file, 64, "use a smaller picture"));
}

}  // namespace twinarm
