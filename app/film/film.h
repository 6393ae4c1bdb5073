// Where the pictures of a film go: a folder of PNG, or a file that the program ffmpeg makes of
// them. Nothing half-made stays behind.
#pragma once

#include <filesystem>
#include <memory>

#include "app/render/list/image.h"

namespace twinarm {

class Film {
 public:
  virtual ~Film() = default;
  virtual void add(const Image& image) = 0;
  virtual void finish() = 0;  // the file has its name from now on
};

// DIR/frame_00000.png and so on; each is whole when it is there.
std::unique_ptr<Film> png_film(const std::filesystem::path& folder);

enum class FilmKind { mp4, gif };
struct FilmFormat {
  FilmKind kind = FilmKind::mp4;
  int width = 0, height = 0;  // [px]
  double rate = 30;           // pictures per second
};
// Throws InputError, here and later, where ffmpeg is missing or fails, or the file cannot be
// written.
std::unique_ptr<Film> ffmpeg_film(const std::filesystem::path& file, const FilmFormat& format);

// The program on the PATH. Throws InputError, naming `option`.
std::filesystem::path find_ffmpeg(const char* option);

}  // namespace twinarm
