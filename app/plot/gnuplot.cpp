#include "app/plot/gnuplot.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "app/data/html_page.h"
#include "app/support/program.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/input_file.h"

namespace twinarm {

const char* const kFigureStyle =
    "set encoding utf8\n"
    "set samples 2\n"
    "set border 3 lc '#555555' lw 1\n"
    "set tics nomirror out scale 0.6\n"
    "set grid lt 1 lc '#E4E4E4' lw 1\n"
    "set key samplen 2.2 spacing 1.15 textcolor '#333333'\n"
    "set xtics textcolor '#333333'\n"
    "set ytics textcolor '#333333'\n";

std::filesystem::path require_gnuplot() {
  const std::filesystem::path program = find_program("gnuplot");
  if (!program.empty()) return program;
  throw InputError("gnuplot", "the program is not in PATH; it draws the figures",
                   "install gnuplot-nox (scripts/setup does)", "program.missing");
}

std::pair<double, double> finite_range(const std::vector<const std::vector<double>*>& curves) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto* values : curves)
    for (const double x : *values)
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  return {low, high};
}

double round_step(double at_least) {
  const double power = std::pow(10, std::floor(std::log10(at_least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= at_least) return factor * power;
  return 10 * power;
}

std::string in_quotes(const std::string& text) {
  return "'" + replace_all(text, "'", "''") + "'";
}

Gnuplot::Gnuplot(std::filesystem::path folder)
    : folder_(std::move(folder)), program_(require_gnuplot()) {}

std::string Gnuplot::data(const std::vector<std::vector<double>>& columns) {
  fmt::memory_buffer text;
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  for (std::size_t n = 0; n < rows; ++n)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double x = columns[c][n];
      if (std::isfinite(x))
        fmt::format_to(std::back_inserter(text), "{:.7g}", x);
      else
        fmt::format_to(std::back_inserter(text), "NaN");
      text.push_back(c + 1 == columns.size() ? '\n' : ' ');
    }
  if (rows == 0) fmt::format_to(std::back_inserter(text), "NaN NaN\n");
  const std::string name = fmt::format("data{}.txt", ++files_);
  write_whole_file(temporary_.folder() / name, fmt::to_string(text));
  return in_quotes(name);
}

std::string Gnuplot::curve(const std::vector<double>& x, const std::vector<double>& y,
                           std::size_t stretches) {
  const std::size_t n = std::min(x.size(), y.size());
  if (n <= 2 * stretches)
    return data({{x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n)},
                 {y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)}});
  std::vector<double> kept_x, kept_y;
  const auto keep = [&](std::size_t i) {
    kept_x.push_back(x[i]);
    kept_y.push_back(y[i]);
  };
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * n / stretches, end = (s + 1) * n / stretches;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
    }
    keep(std::min(low, high));
    if (low != high) keep(std::max(low, high));
  }
  keep(n - 1);  // the last point
  return data({kept_x, kept_y});
}

std::string Gnuplot::run(const std::string& name, const char* extension,
                         const std::string& terminal, const std::string& script) {
  const std::filesystem::path made = temporary_.folder() / (name + extension);
  const std::filesystem::path input = temporary_.folder() / (name + ".gp");
  const std::filesystem::path messages = temporary_.folder() / (name + ".log");
  write_whole_file(input,
                   fmt::format("cd {}\nset terminal {}\nset output '{}'\n{}{}\nunset output\n",
                               in_quotes(temporary_.folder().string()), terminal,
                               made.filename().string(), kFigureStyle, script));
  const int in = open(input.c_str(), O_RDONLY | O_CLOEXEC);
  const int out = open(messages.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  // Without the user's own ~/.gnuplot.
  const pid_t child = start_program({program_.string(), "--default-settings"}, in, out, out);
  close(in);
  close(out);
  const bool is_drawn = child > 0 && exit_code_of(child) == 0 && std::filesystem::exists(made);
  check_interrupt();
  if (!is_drawn)
    throw std::runtime_error("gnuplot could not draw " + name + ": " +
                             (std::filesystem::exists(messages) ? read_whole_file(messages) : ""));
  return read_whole_file(made);
}

std::string Gnuplot::png(const std::string& name, int width, int height,
                         const std::string& script) {
  return run(name, ".png",
             fmt::format("pngcairo size {},{} noenhanced font 'DejaVu Sans,11' rounded background "
                         "'#FFFFFF'",
                         width, height),
             script);
}

std::string Gnuplot::svg(const std::string& name, const std::string& title, int width, int height,
                         const std::string& script) {
  std::string drawn =
      run(name, ".svg",
          fmt::format("svg size {},{} noenhanced font 'DejaVu Sans,13' rounded background "
                      "'#FFFFFF' name '{}'",
                      width, height, name),
          script);
  // Unique ids for several figures in a page, fallback fonts, the title.
  const auto replace = [&](const std::string& from, const std::string& to) {
    drawn = replace_all(std::move(drawn), from, to);
  };
  for (const std::string id : {"gnuplot_canvas", "textbox", "greybox"})
    for (const auto& [before, after] : {std::pair{"\"", "\""}, {"'", "'"}, {"#", ")"}})
      replace(before + id + after, before + name + "_" + id + after);
  replace("'gp", "'" + name + "_gp");
  replace("#gp", "#" + name + "_gp");
  replace("\"DejaVu Sans\"", "\"DejaVu Sans, Verdana, sans-serif\"");
  replace("<title>" + name + "</title>", "<title>" + escaped(title) + "</title>");
  const std::size_t begin = drawn.find("<desc>"), end = drawn.find("</desc>");
  if (end != std::string::npos && begin < end) drawn.erase(begin, end + 7 - begin);
  return drawn;
}

void Gnuplot::draw(const std::string& name, const std::string& title, int width, int height,
                   const std::string& script) {
  write_whole_file(folder_ / (name + ".svg"), svg(name, title, width, height, script));
}

}  // namespace twinarm
