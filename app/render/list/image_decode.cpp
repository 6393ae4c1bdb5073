// PNG by libpng's simplified interface, JPEG by libjpeg-turbo's: whole files in memory.
#include <png.h>
#include <turbojpeg.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "app/render/list/image.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr int kMostPixels = 1 << 26;   // 8192 x 8192
constexpr int kLongestSide = 1 << 14;  // of a texture, in Mesa

[[noreturn]] void refuse(const std::string& name, const std::string& rule) {
  throw InputError({Fault{name, 0, "picture", rule, "save it again as PNG or JPEG"}});
}

Image sized(const std::string& name, std::int64_t width, std::int64_t height) {
  if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide ||
      width * height > kMostPixels)
    refuse(name, "has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, must have 1 to 67 million, at most 16384 along a side");
  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.rgba.resize(4 * static_cast<std::size_t>(width * height));
  return image;
}

Image decode_png(const std::string& name, std::string_view bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&png, png_image_free);
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
    refuse(name, std::string("is no PNG: ") + png.message);
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
    refuse(name, "is no JPEG");
  Image image = sized(name, width, height);
  if (tjDecompress2(jpeg.get(), data, bytes.size(), image.rgba.data(), width, 0, height, TJPF_RGBA,
                    TJFLAG_STOPONWARNING) != 0)
    refuse(name, std::string("is broken: ") + tjGetErrorStr2(jpeg.get()));
  return image;
}

}  // namespace

Image decode_image(const std::string& name, std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return decode_png(name, bytes);
  if (bytes.starts_with("\xff\xd8")) return decode_jpeg(name, bytes);
  refuse(name, "is neither a PNG nor a JPEG");
}

Image read_image(const std::filesystem::path& file) {
  std::error_code error;
  constexpr std::uintmax_t kMostPictureBytes = 64u << 20;
  if (std::filesystem::file_size(file, error) > kMostPictureBytes && !error)
    refuse(file.string(), "has more than 64 MiB");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) refuse(file.string(), "cannot be read");
  return decode_image(file.string(), std::move(bytes).str());
}

}  // namespace twinarm
