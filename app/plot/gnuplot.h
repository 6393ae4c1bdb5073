// Line plots by the gnuplot program: data files in a temporary folder, script on standard input.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/support/files.h"

namespace twinarm {

// Colours of figures; they differ in lightness and width too, for grey prints and colour-blind
// readers.
namespace palette {
inline constexpr const char* kvr = "#8FA9C0";  // grey-blue, drawn wide
inline constexpr const char* dvr = "#D2600A";  // orange, drawn narrow on top
inline constexpr const char* torsional = "#7B3F8F";
inline constexpr const char* linear = "#00856F";
inline constexpr const char* ink = "#333333";
inline constexpr const char* faint = "#9A9A9A";
}  // namespace palette

extern const char* const kFigureStyle;  // of each figure; repeat after gnuplot's `reset`

// The program. Throws InputError if it is not in PATH: call it before long computations.
std::filesystem::path require_gnuplot();

class Gnuplot {
 public:
  // Throws InputError like require_gnuplot(). `folder`: of draw().
  explicit Gnuplot(std::filesystem::path folder = {});

  // Columns of equal length; returns the quoted file name for the script. Values that are not
  // finite make a gap.
  std::string data(const std::vector<std::vector<double>>& columns);
  // A curve reduced to the minimum and maximum of each stretch.
  std::string curve(const std::vector<double>& x, const std::vector<double>& y,
                    std::size_t stretches = 700);  // about one per pixel of a figure's width
  // The SVG; `name` makes its ids unique in a page, `title` is for screen readers.
  std::string svg(const std::string& name, const std::string& title, int width, int height,
                  const std::string& script);
  std::string png(const std::string& name, int width, int height, const std::string& script);
  // Writes folder/name.svg.
  void draw(const std::string& name, const std::string& title, int width, int height,
            const std::string& script);

 private:
  // Output of gnuplot for this terminal.
  std::string run(const std::string& name, const char* extension, const std::string& terminal,
                  const std::string& script);
  std::filesystem::path folder_, program_;
  TemporaryFiles temporary_{"twinarm-figures"};
  int files_ = 0;
};

// Smallest and largest finite value of all curves; {inf, -inf} if there is none.
std::pair<double, double> finite_range(const std::vector<const std::vector<double>*>& curves);

double round_step(double at_least);  // 1, 2 or 5 times a power of ten

// Text in a script: in single quotes, inner ones doubled.
std::string in_quotes(const std::string& text);

}  // namespace twinarm
