#include "app/compare/small_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace twinarm::compare_page {
namespace {

void remove_all(std::string& text, std::string_view what, std::string_view by = "") {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

std::vector<std::string> trimmed_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t begin = text.find_first_not_of(" \t", at);
    if (begin < end) lines.push_back(text.substr(begin, end - begin));
    at = end + 1;
  }
  return lines;
}

// Numbers to one decimal; of lines "L", which may be left out, none.
void append_rounded(std::string& text, std::string_view places) {
  for (std::size_t i = 0; i < places.size();) {
    const char c = places[i] == '\n' ? ' ' : places[i];
    const auto digit = [&](std::size_t k) {
      return k < places.size() && (std::isdigit(static_cast<unsigned char>(places[k])) != 0 ||
                                   places[k] == '.' || (k == i && places[k] == '-'));
    };
    std::size_t end = i;
    while (digit(end)) ++end;
    if (end == i) {
      if (c != 'L' && !(c == ' ' && (text.back() == ' ' || i + 1 == places.size()))) text += c;
      ++i;
      continue;
    }
    text += fmt::format("{:.1f}", std::atof(std::string(places.substr(i, end - i)).c_str()));
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    i = end;
  }
}

// From `from` on, what stands between `open` and `close`, wherever they do, rounded.
std::string with_rounded(const std::string& text, std::size_t from, std::string_view open,
                         char close) {
  std::string all = text.substr(0, from);
  while (true) {
    const std::size_t at = text.find(open, from);
    const std::size_t end = at == std::string::npos ? at : text.find(close, at + open.size());
    if (end == std::string::npos) return all + text.substr(from);
    all += text.substr(from, at + open.size() - from);
    append_rounded(all, std::string_view(text).substr(at + open.size(), end - at - open.size()));
    from = end;
  }
}

// Of a mark that a line of <defs> makes; empty where it makes none.
std::string mark_of(const std::string& line) {
  const std::size_t id = line.find(" id='");
  if (id == std::string::npos) return "";
  return line.substr(id + 5, line.find('\'', id + 5) - id - 5);
}

// Three times, for marks are made of marks.
void remove_unused_marks(std::vector<std::string>& lines) {
  for (int pass = 0; pass < 3; ++pass) {
    std::string used;
    for (const std::string& line : lines)
      for (std::size_t at = line.find("href='#"); at != std::string::npos;
           at = line.find("href='#", at + 1))
        used += line.substr(at + 6, line.find('\'', at + 7) - at - 6) + " ";
    std::erase_if(lines, [&](const std::string& line) {
      const std::string mark = mark_of(line);
      return !mark.empty() && line[1] != 'f' && used.find("#" + mark + " ") == std::string::npos;
    });
  }
}

void remove_filters(std::vector<std::string>& lines) {
  bool within = false;
  std::erase_if(lines, [&](const std::string& line) {
    within |= line.starts_with("<filter");
    const bool gone = within;
    if (line.starts_with("</filter")) within = false;
    return gone;
  });
}

}  // namespace

std::string small_svg(const std::string& svg) {
  std::vector<std::string> lines = trimmed_lines(svg);
  remove_filters(lines);
  remove_unused_marks(lines);
  std::string small;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    const bool opens = line.starts_with("<g fill=\"none\"");
    if (opens && i + 1 < lines.size() && lines[i + 1] == "</g>") {
      ++i;
      continue;
    }
    small += line + "\n";
  }
  const std::size_t drawn =
      std::min(small.find("</defs>"), small.size());  // marks stay as they are
  small = with_rounded(small, drawn, " d='", '\'');
  small = with_rounded(small, drawn, "translate(", ')');
  for (const std::string_view gone :
       {" stroke-linecap=\"round\" stroke-linejoin=\"round\"", " stroke=\"currentColor\"",
        " font-family=\"DejaVu Sans, Verdana, sans-serif\"", " class=\"gridline\"",
        " color=\"black\"", "<tspan font-size=\"13.0\" dy=\"6.50\"></tspan>",
        " stroke-width=\"1.00\""})
    remove_all(small, gone);
  remove_all(small, "<g fill=\"none\"", "<g class=l");
  remove_all(small, "xlink:href", "href");
  remove_all(small, "color='rgb( 17,  17,  17)'", "color=#111");
  remove_all(small, "color=#111/>", "color=#111 />");
  remove_all(small, "rgb(228, 228, 228)", "#e4e4e4");
  remove_all(small, "rgb( 85,  85,  85)", "#555");
  remove_all(small, "rgb(51,51,51)", "#333");
  return small;
}

}  // namespace twinarm::compare_page
