#include "app/plot/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "app/data/html_page.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

extern char** environ;

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

namespace {

std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (const std::string& folder : split(path ? path : "", ':')) {
    const std::filesystem::path candidate = std::filesystem::path(folder) / name;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  throw InputError({{"", 0, name, "the program is not in PATH; it draws the figures",
                     "install gnuplot-nox (scripts/setup does)", "program.missing"}});
}

// Runs the script in `folder`, without a shell.
bool run_gnuplot(const std::filesystem::path& folder, const std::filesystem::path& script,
                 const std::filesystem::path& messages) {
  const std::string program = find_program("gnuplot").string();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, script.c_str(), O_RDONLY, 0);
  for (int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, messages.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string name = "gnuplot", option = "--default-settings";  // not the user's own ~/.gnuplot
  char* arguments[] = {name.data(), option.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

void require_gnuplot() {
  find_program("gnuplot");
}

std::string in_quotes(const std::string& text) {
  std::string doubled = text;
  replace_all(doubled, "'", "''");
  return "'" + doubled + "'";
}

Gnuplot::Gnuplot(std::filesystem::path folder) : folder_(std::move(folder)) {
  require_gnuplot();
  temporary_ = make_temporary_folder("twinarm-figures");
}

Gnuplot::~Gnuplot() {
  std::error_code ignored;
  std::filesystem::remove_all(temporary_, ignored);
}

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
  write_whole_file(temporary_ / name, fmt::to_string(text));
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
  const std::filesystem::path made = temporary_ / (name + extension);
  const std::filesystem::path input = temporary_ / (name + ".gp");
  const std::filesystem::path messages = temporary_ / (name + ".log");
  write_whole_file(
      input, fmt::format("set terminal {}\nset output '{}'\n", terminal, made.filename().string()) +
                 kFigureStyle + script + "\nunset output\n");
  const bool is_drawn = run_gnuplot(temporary_, input, messages) && std::filesystem::exists(made);
  check_interrupt();  // Ctrl-C ends gnuplot too
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
  for (const char* id : {"gnuplot_canvas", "textbox", "greybox"}) {
    replace_all(drawn, fmt::format("\"{}\"", id), fmt::format("\"{}_{}\"", name, id));
    replace_all(drawn, fmt::format("'{}'", id), fmt::format("'{}_{}'", name, id));
    replace_all(drawn, fmt::format("#{})", id), fmt::format("#{}_{})", name, id));
  }
  replace_all(drawn, "'gp", "'" + name + "_gp");
  replace_all(drawn, "#gp", "#" + name + "_gp");
  replace_all(drawn, "\"DejaVu Sans\"", "\"DejaVu Sans, Verdana, sans-serif\"");
  replace_all(drawn, "<title>" + name + "</title>", "<title>" + escaped(title) + "</title>");
  const std::size_t begin = drawn.find("<desc>"), end = drawn.find("</desc>");
  if (end != std::string::npos && begin < end) drawn.erase(begin, end + 7 - begin);
  return drawn;
}

void Gnuplot::draw(const std::string& name, const std::string& title, int width, int height,
                   const std::string& script) {
  write_whole_file(folder_ / (name + ".svg"), svg(name, title, width, height, script));
}

}  // namespace twinarm
