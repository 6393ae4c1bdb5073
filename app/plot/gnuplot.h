// Line plots by the gnuplot program: data files in a temporary folder, a script on its standard
// input, an SVG that is whole or not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace twinarm {

// The palette and the line styles of all figures. They differ in lightness and width as well as in
// hue, so that a grey print and a colour-blind reader can tell them apart.
namespace palette {
inline constexpr const char* kvr = "#8FA9C0";  // grey-blue, drawn wide
inline constexpr const char* dvr = "#D2600A";  // orange, drawn narrow on top
inline constexpr const char* torsional = "#7B3F8F";
inline constexpr const char* linear = "#00856F";
inline constexpr const char* ink = "#333333";
inline constexpr const char* faint = "#9A9A9A";
}  // namespace palette

extern const char* const kFigureStyle;  // in each figure; again after gnuplot's `reset`

// Throws InputError where there is no gnuplot in PATH: what will draw asks before it computes.
void require_gnuplot();

class Gnuplot {
 public:
  // Throws InputError if there is no gnuplot in PATH, or no room for what it is given. `folder` is
  // that of draw().
  explicit Gnuplot(std::filesystem::path folder = {});
  ~Gnuplot();
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  // Columns of equal length; the result is the quoted file name for the script. What is not finite
  // becomes a gap.
  std::string data(const std::vector<std::vector<double>>& columns);
  // A curve, thinned to what can be seen: of each of many stretches its lowest and highest point.
  std::string curve(const std::vector<double>& x, const std::vector<double>& y,
                    std::size_t stretches = 700);  // about one per pixel of a figure's width
  // The SVG; `name` tells its ids from those of other figures of a page, `title` is what a screen
  // reader says.
  std::string svg(const std::string& name, const std::string& title, int width, int height,
                  const std::string& script);
  // The same as a PNG of so many pixels.
  std::string png(const std::string& name, int width, int height, const std::string& script);
  // Makes folder/name.svg of it.
  void draw(const std::string& name, const std::string& title, int width, int height,
            const std::string& script);

 private:
  // What gnuplot writes for this terminal.
  std::string run(const std::string& name, const char* extension, const std::string& terminal,
                  const std::string& script);
  std::filesystem::path folder_, temporary_;
  int files_ = 0;
};

// Text in a script: in single quotes, inner ones doubled.
std::string in_quotes(const std::string& text);

}  // namespace twinarm
