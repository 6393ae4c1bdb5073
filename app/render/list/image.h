// Image: a picture in memory, PNG out of it, PNG and JPEG into it.
//
// Rows run from the top to the bottom, pixels from left to right, four sRGB bytes each: red, green,
// blue, alpha (255 = opaque).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

struct Image {
  int width = 0, height = 0;       // [px]
  std::vector<std::uint8_t> rgba;  // 4 * width * height bytes

  std::uint8_t* pixel(int x, int y) { return rgba.data() + 4 * offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgba.data() + 4 * offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// All bytes alike: 0 is clear black, 255 opaque white.
Image make_image(int width, int height, std::uint8_t byte = 0);

// The bytes of a PNG file, without alpha where the whole picture is opaque. Throws InputError on an
// empty or inconsistent image.
std::string encode_png(const Image& image);

// Writes the file under a temporary name beside `path` and renames it: who watches the folder never
// sees half a picture. Throws InputError where the folder cannot be written.
void write_png(const std::string& path, const Image& image);

// The picture in the bytes of a PNG or JPEG file; `name` is what errors call it. Throws InputError
// where it is neither, broken, or larger than 67 million pixels.
Image decode_image(const std::string& name, std::string_view bytes);
// The same of a file, which may be missing.
Image read_image(const std::filesystem::path& file);

}  // namespace twinarm
