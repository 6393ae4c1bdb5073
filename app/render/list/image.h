// Image: pixels in memory, written as PNG, read from PNG and JPEG.
//
// Rows from top to bottom, pixels from left to right, sRGB bytes: red, green, blue, alpha.
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

// 0: transparent black, 255: opaque white.
Image make_image(int width, int height, std::uint8_t byte = 0);

// For the transfer between processes. Throws std::runtime_error if it is not a packed image.
class StateArchive;
void serialize(StateArchive& archive, Image& image);

// Bytes of a PNG file, without alpha if the image is opaque. Throws InputError on an empty or
// inconsistent image.
std::string encode_png(const Image& image);

// Writes atomically. Throws InputError if the folder cannot be written.
void write_png(const std::string& path, const Image& image);

// From the bytes of a PNG or JPEG file; `name` is for messages. Throws InputError if it is neither,
// broken, or larger than 67 million pixels.
Image decode_image(const std::string& name, std::string_view bytes);
// Throws also if the file is missing.
Image read_image(const std::filesystem::path& file);

}  // namespace twinarm
