#include "app/compare/page/small_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "app/compare/page/svg_path.h"

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

// Two numbers to one decimal.
std::string rounded(std::string_view numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end < numbers.size() && (std::isdigit(static_cast<unsigned char>(numbers[end])) != 0 ||
                                    numbers[end] == '.' || (end == i && numbers[end] == '-')))
      ++end;
    if (end == i) {
      text += numbers[i++];
      continue;
    }
    text += fmt::format("{:.1f}", std::atof(std::string(numbers.substr(i, end - i)).c_str()));
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    i = end;
  }
  return text;
}

// From `from` on, what stands between `open` and `close`, wherever they do, by another text.
template <class F>
std::string with_each(const std::string& text, std::size_t from, std::string_view open,
                      std::string_view close, F&& other) {
  std::string all = text.substr(0, from);
  while (true) {
    const std::size_t at = text.find(open, from);
    const std::size_t end = at == std::string::npos ? at : text.find(close, at + open.size());
    if (end == std::string::npos) return all + text.substr(from);
    all += text.substr(from, at - from);
    all += other(std::string_view(text).substr(at + open.size(), end - at - open.size()));
    from = end + close.size();
  }
}

// The value of an attribute of a tag; empty where it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::size_t at = tag.find(name);
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + name.size();
  return tag.substr(begin, tag.find('"', begin) - begin);
}

// A label without the group around it; its looks are in the style sheet but for what is unusual.
// `inside` goes from the group's translation to the end of its text.
std::string plain_label(std::string_view inside) {
  const std::size_t open = inside.find("<text"), begin = inside.find('>', open) + 1;
  const std::string_view tag = inside.substr(0, open), words = inside.substr(begin);
  const std::size_t first = words.find_first_not_of(' ');
  if (first == std::string_view::npos) return "";
  const std::size_t comma = tag.find(','), close = tag.find(')');
  std::string label = "<text";
  if (tag.substr(close, 2) == ")\"")
    label +=
        fmt::format(" x={} y={}", tag.substr(0, comma), tag.substr(comma + 1, close - comma - 1));
  else
    label += fmt::format(" transform=\"translate({}\"", tag.substr(0, tag.find('"')));
  const std::string_view size = attribute(tag, "font-size=\""), side = attribute(tag, "anchor=\"");
  if (size != "13.00") label += fmt::format(" font-size={}", size);
  if (side != "start") label += fmt::format(" class={}", side.substr(0, 1));
  return label + ">" + std::string(words.substr(first)) + "</text>";
}

// The circles of references are most of all marks: written as what they are. `inside` goes from the
// name of the mark to the end of the tag.
std::string plain_mark(std::string_view inside) {
  const std::size_t place = inside.find("translate("), scale = inside.find("scale(");
  if (inside.find("gpPt5'") == std::string_view::npos || scale == std::string_view::npos ||
      !inside.ends_with("color=#111 "))
    return "<use href='#" + std::string(inside) + "/>";
  const std::string_view at = inside.substr(place + 10);
  const std::size_t comma = at.find(',');
  return fmt::format("<circle class=o cx={} cy={} r={:.1f} />", at.substr(0, comma),
                     at.substr(comma + 1, at.find(')') - comma - 1),
                     std::atof(std::string(inside.substr(scale + 6)).c_str()));
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
  small = with_each(small, drawn, " d='", "'",
                    [](std::string_view d) { return " d='" + short_path(d) + "'"; });
  small = with_each(small, drawn, "translate(", ")",
                    [](std::string_view numbers) { return "translate(" + rounded(numbers) + ")"; });
  small = with_each(small, drawn, "<g transform=\"translate(", "</text>\n</g>", plain_label);
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
  for (const auto& [colour, kind] : {std::pair{"#e4e4e4", "g"}, {"#555", "k"}})
    small = with_each(small, drawn, fmt::format("<g class=l>\n<path stroke='{}'  d=", colour),
                      "</g>", [kind = kind](std::string_view line) {
                        return fmt::format("<path class={} d={}", kind, line);
                      });
  small = with_each(small, drawn, "<use href='#", "/>", plain_mark);
  // Browsers would show these names where the pointer is.
  small = with_each(small, drawn, "<title>", "</title>", [](std::string_view) { return ""; });
  small = with_each(small, drawn, "<g id=\"", "\" >", [](std::string_view) { return "<g>"; });
  remove_all(small, "\n\n", "\n");
  return small;
}

}  // namespace twinarm::compare_page
