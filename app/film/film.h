// Output of a film: a folder of PNG files, or a video file by ffmpeg. Incomplete files are removed.
#pragma once

#include <filesystem>
#include <memory>

#include "app/render/list/image.h"

namespace twinarm {

class Film {
 public:
  virtual ~Film() = default;
  virtual void add(const Image& image) = 0;
  virtual void finish() = 0;  // renames the temporary file
};

// DIR/frame_00000.png, ...; each is written atomically.
std::unique_ptr<Film> png_film(const std::filesystem::path& folder);

enum class FilmKind { mp4, gif };
struct FilmFormat {
  FilmKind kind = FilmKind::mp4;
  int width = 0, height = 0;  // [px]
  double rate = 30;           // pictures per second
};
// Throws InputError, here and later, if ffmpeg is missing or fails or the file cannot be written.
std::unique_ptr<Film> ffmpeg_film(const std::filesystem::path& file, const FilmFormat& format);

// From the PATH. Throws InputError with `option`.
std::filesystem::path find_ffmpeg(const char* option);

}  // namespace twinarm
