#include "coupling/recorded_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "solver/fault.h"
#include "solver/whole_file.h"

namespace twinarm {
namespace {

constexpr std::array<const char*, 7> kColumns{"t[s]",        "theta1[rad]", "theta2[rad]",
                                              "theta3[rad]", "theta4[rad]", "theta5[rad]",
                                              "theta6[rad]"};
constexpr std::size_t kMostFaults = 20;  // of one file; a wrong unit would name every line

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

bool to_number(const std::string& cell, double& value) {
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return result.ec == std::errc() && result.ptr == cell.data() + cell.size() &&
         std::isfinite(value);
}

}  // namespace

RecordedTrace::RecordedTrace(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream stream(file);
  if (!stream)
    throw InputError({{file_, 0, "", "the trace cannot be opened", "name a CSV file that exists"}});
  FaultList faults;
  std::size_t fault_count = 0;
  const auto add = [&](int line, const std::string& where, const std::string& rule,
                       const std::string& remedy) {
    if (++fault_count <= kMostFaults) faults.add({file_, line, where, rule, remedy});
  };

  std::array<std::size_t, 8> column{};  // of t, theta1..theta6, button
  bool have_header = false, have_button = false;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    const std::vector<std::string> cells = split(line);
    const bool blank = cells.empty() || (cells.size() == 1 && cells[0].empty());
    if (blank || cells[0].starts_with("#")) continue;
    const auto find = [&](const char* name) {
      return static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin());
    };
    if (!have_header) {
      have_header = true;
      for (std::size_t c = 0; c < kColumns.size(); ++c) {
        column[c] = find(kColumns[c]);
        if (column[c] == cells.size())
          add(line_number, "header", fmt::format("column '{}' is missing", kColumns[c]),
              "give the columns t[s], theta1[rad] to theta6[rad], and button if there is one");
      }
      column[7] = find("button");
      have_button = column[7] < cells.size();
      faults.check();
      continue;
    }
    Sample sample{};
    double button = 0;
    bool good = true;
    for (std::size_t c = 0; c < (have_button ? 8u : 7u); ++c) {
      double& value = c == 0 ? sample.t : c == 7 ? button : sample.theta[c - 1];
      const std::string cell = column[c] < cells.size() ? cells[column[c]] : "";
      if (to_number(cell, value)) continue;
      good = false;
      add(line_number, c == 7 ? "button" : kColumns[c],
          fmt::format("'{}' is not a finite number", cell), "mend or remove the line");
    }
    if (!good) continue;
    sample.button = button != 0;
    if (!samples_.empty() && !(sample.t > samples_.back().t)) {
      add(line_number, "t[s]",
          fmt::format("time runs back from {} to {} s", samples_.back().t, sample.t),
          "sort the lines by time, one line for each instant");
      continue;
    }
    samples_.push_back(sample);
  }
  if (fault_count == 0 && samples_.size() < 2)
    add(0, "", "the trace has fewer than two samples", "give a header line and at least two lines");
  if (fault_count > kMostFaults)
    faults.add({file_, 0, "", fmt::format("and {} more faults", fault_count - kMostFaults), ""});
  faults.check();
  const double start = samples_.front().t;
  for (Sample& sample : samples_) sample.t -= start;
}

HandSample RecordedTrace::sample(double t, double toward) const {
  // The interval that a step between t and toward belongs to.
  const double inside = t + 1e-9 * (toward - t);
  auto after = std::upper_bound(samples_.begin(), samples_.end(), inside,
                                [](double time, const Sample& s) { return time < s.t; });
  after = std::clamp(after, samples_.begin() + 1, samples_.end() - 1);
  const Sample& a = *std::prev(after);
  const Sample& b = *after;
  HandSample hand;
  const double s = std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0);
  const bool moving = t < samples_.back().t || toward < samples_.back().t;
  for (std::size_t j = 0; j < 6; ++j) {
    hand.theta[j] = a.theta[j] + s * (b.theta[j] - a.theta[j]);
    hand.theta_dot[j] = moving ? (b.theta[j] - a.theta[j]) / (b.t - a.t) : 0.0;
  }
  hand.button = t >= b.t ? b.button : a.button;
  return hand;
}

std::string RecordedTrace::description() const {
  return fmt::format("recorded trace {}, {} samples, {:.3g} s", file_, samples_.size(), duration());
}

void write_trace(const HandSource& hand, double rate, const std::filesystem::path& file) {
  std::string text = "# " + hand.description() + "\n";
  for (const char* column : kColumns) text += fmt::format("{},", column);
  text += "button\n";
  const auto count = static_cast<long>(std::floor(hand.duration() * rate)) + 1;
  for (long n = 0; n < count; ++n) {
    const double t = static_cast<double>(n) / rate;
    const HandSample sample = hand.sample(t, t + 1 / rate);
    text += fmt::format("{:.6f}", t);
    for (double theta : sample.theta) text += fmt::format(",{:.6f}", theta);
    text += sample.button ? ",1\n" : ",0\n";
  }
  write_whole_file(file, text);
}

}  // namespace twinarm
