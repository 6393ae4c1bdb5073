#include "app/film/rendering.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "app/support/program.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

class PngFilm final : public Film {
 public:
  explicit PngFilm(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
      throw InputError(
          {{folder_.string(), 0, "--frames", "the folder cannot be created: " + error.message(),
            "give a writable folder", "file.unwritable"}});
  }
  void add(const Image& image) override {
    write_png((folder_ / fmt::format("frame_{:05}.png", count_++)).string(), image);
  }
  void finish() override {}

 private:
  std::filesystem::path folder_;
  int count_ = 0;
};

std::vector<std::string> ffmpeg_words(const std::string& program, const std::string& out,
                                      const FilmFormat& format) {
  // yuv420p needs even sizes; a GIF has one palette for all frames.
  const char* const mp4 =
      "-vf pad=ceil(iw/2)*2:ceil(ih/2)*2 -c:v libx264 -crf 18 -preset fast -pix_fmt yuv420p "
      "-movflags +faststart -f mp4";
  const char* const gif =
      "-filter_complex [0:v]split[a][b];[a]palettegen=stats_mode=diff[p];"
      "[b][p]paletteuse=dither=bayer:bayer_scale=4 -loop 0 -f gif";
  const std::string options = fmt::format(
      "-hide_banner -loglevel error -y -f rawvideo -pix_fmt rgba -s {}x{} -r {:g} -i - -an {}",
      format.width, format.height, format.rate, format.kind == FilmKind::mp4 ? mp4 : gif);
  std::vector<std::string> words = split(options, ' ');
  words.insert(words.begin(), program);
  words.push_back(out);
  return words;
}

class FfmpegFilm final : public Film {
 public:
  FfmpegFilm(std::filesystem::path file, const FilmFormat& format)
      : file_(std::move(file)), out_(file_, file_.string() + ".part") {
    std::signal(SIGPIPE, SIG_IGN);  // write() reports that the child has ended
    const std::string option = format.kind == FilmKind::mp4 ? "--mp4" : "--gif";
    // The whole path: "-x.mp4" would be an option, "http:x.mp4" a stream.
    start(ffmpeg_words(find_ffmpeg(option.c_str()).string(),
                       std::filesystem::absolute(out_.temporary()).string(), format));
  }
  ~FfmpegFilm() override {
    if (child_ > 0) {  // not finished
      close_pipe();
      kill(child_, SIGKILL);
      exit_code_of(child_);
    }
  }
  FfmpegFilm(const FfmpegFilm&) = delete;
  FfmpegFilm& operator=(const FfmpegFilm&) = delete;

  void add(const Image& image) override {
    std::size_t at = 0;
    while (at < image.rgba.size()) {
      const ssize_t wrote = write(pipe_, image.rgba.data() + at, image.rgba.size() - at);
      if (wrote < 0 && errno == EINTR) {
        check_interrupt();
        continue;
      }
      if (wrote < 0) fail();
      at += static_cast<std::size_t>(wrote);
    }
  }
  void finish() override {
    close_pipe();
    if (exit_code_of(std::exchange(child_, 0)) != 0) fail();
    out_.finish();
  }

 private:
  void start(const std::vector<std::string>& words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail();
    child_ = start_program(words, ends[0], STDERR_FILENO, STDERR_FILENO);
    const int error = errno;
    close(ends[0]);
    pipe_ = ends[1];
    if (child_ > 0) return;
    close_pipe();
    throw InputError({{words[0], 0, "", std::string("cannot be started: ") + strerror(error),
                       "reinstall ffmpeg, or use --frames DIR", "program.not-started"}});
  }
  void close_pipe() {
    if (pipe_ >= 0) close(pipe_);
    pipe_ = -1;
  }
  [[noreturn]] void fail() {
    throw InputError(
        {{file_.string(), 0, "ffmpeg", "ffmpeg failed; see its messages above",
          "check that the folder is writable; --frames DIR needs no ffmpeg", "program.failed"}});
  }

  std::filesystem::path file_;
  UnfinishedFile out_;  // ffmpeg writes it
  pid_t child_ = 0;
  int pipe_ = -1;
};

}  // namespace

std::unique_ptr<Film> png_film(const std::filesystem::path& folder) {
  return std::make_unique<PngFilm>(folder);
}

std::unique_ptr<Film> ffmpeg_film(const std::filesystem::path& file, const FilmFormat& format) {
  return std::make_unique<FfmpegFilm>(file, format);
}

std::filesystem::path find_ffmpeg(const char* option) {
  const std::filesystem::path program = find_program("ffmpeg");
  if (!program.empty()) return program;
  throw InputError(option, "needs the program ffmpeg, which is not on the PATH",
                   "install it (apt-get install ffmpeg), or use --frames DIR", "program.missing");
}

}  // namespace twinarm
