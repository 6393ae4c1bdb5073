// Pictures of a run, or of two side by side at the same instants, with curves below them.
#pragma once

#include "app/draw/curves.h"
#include "app/film/filmed_run.h"
#include "app/render/gl/painter.h"

namespace twinarm {

struct PictureWish {
  int width = 0, height = 0;  // [px]
  Quality quality = Quality::normal;
  Background background;
  Backend backend = Backend::osmesa;
  std::string camera = "auto";
  double field_of_view = Camera{}.field_of_view;  // vertical [rad]
  double orbit = 0;                               // about the vertical, per picture [rad]
  std::vector<std::string> overlays;
  std::vector<const CurveKind*> curves;
};

// Two runs share camera and scales.
class Rendering {
 public:
  // The runs must outlive it and have equal numbers of pictures. Throws InputError.
  Rendering(const PictureWish& wish, const std::vector<FilmedRun*>& runs);
  ~Rendering();
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;

  Image paint(std::size_t picture);
  std::vector<std::string> notes() const;

 private:
  class View;
  PictureWish wish_;
  std::vector<std::unique_ptr<View>> views_;
};

// Output of a film: a folder of PNG files, or a video file by ffmpeg. Incomplete files are removed.

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
