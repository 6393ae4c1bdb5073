#include "app/compare/page/formulas.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "app/data/html_text.h"

namespace twinarm::compare_page {
namespace {

// Runs of two letters are products of quantities, but for these; longer ones are words.
constexpr std::string_view kShortWords[] = {"am", "cn", "sn", "dn", "cd", "at", "in", "is", "of",
                                            "on", "so", "kg", "Hz", "ms", "mm", "by", "to", "tg"};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

struct Entity {
  std::string_view name, text;
};
constexpr Entity kEntities[] = {
    {"&radic;", "√"}, {"&minus;", "−"}, {"&pi;", "π"},  {"&omega;", "ω"}, {"&theta;", "θ"},
    {"&phi;", "φ"},   {"&tau;", "τ"},   {"&mu;", "μ"},  {"&alpha;", "α"}, {"&lambda;", "λ"},
    {"&Phi;", "Φ"},   {"&beta;", "β"},  {"&deg;", "°"}, {"&times;", "×"}};

std::string plain(std::string_view html) {
  std::string text(html);
  for (const Entity& e : kEntities)
    for (std::size_t at = text.find(e.name); at != std::string::npos;
         at = text.find(e.name, at + e.text.size()))
      text.replace(at, e.name.size(), e.text);
  return text;
}

// The end of the bracket that opens at `open`; npos where it does not close.
std::size_t closing(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i;
  }
  return std::string_view::npos;
}

std::size_t letters_from(std::string_view text, std::size_t at) {
  std::size_t n = 0;
  while (at + n < text.size() && is_letter(text[at + n])) ++n;
  return n;
}

std::string set_letters(std::string_view run) {
  const bool word = run.size() > 2 ||
                    (run.size() == 2 && std::find(std::begin(kShortWords), std::end(kShortWords),
                                                  run) != std::end(kShortWords));
  return word ? std::string(run) : "<i>" + std::string(run) + "</i>";
}

std::string set_text(std::string_view text);

// What begins at `at` and is no run of letters: its HTML; `at` moves behind it. At depth 0 a comma
// parts two equations, between which a line may break.
std::string set_sign(std::string_view text, std::size_t& at, int depth) {
  const auto starts = [&](std::string_view what) { return text.substr(at).starts_with(what); };
  if (text[at] == '<' || text[at] == '&') {  // tags and entities as they are
    const std::size_t end = text.find(text[at] == '<' ? '>' : ';', at);
    const std::size_t count = end == std::string_view::npos ? 1 : end + 1 - at;
    at += count;
    return std::string(text.substr(at - count, count));
  }
  if (starts("√(")) {
    const std::size_t open = at + std::string_view("√").size(), end = closing(text, open);
    if (end != std::string_view::npos) {
      at = end + 1;
      return "√<span class=root>" + set_text(text.substr(open + 1, end - open - 1)) + "</span>";
    }
  }
  if (starts("''")) return at += 2, "″";
  if (starts("'")) return at += 1, "′";
  if (starts(", ") && depth == 0) return at += 2, ",</span>&emsp; <span class=eq>";
  const auto first = static_cast<unsigned char>(text[at]);
  std::size_t count = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  count = std::min(count, text.size() - at);
  const std::string sign(text.substr(at, count));
  at += count;
  const bool greek = first == 0xCE || first == 0xCF;
  const bool capital = greek && (sign == "Σ" || sign == "Δ");  // signs of operations
  return greek && !capital ? "<i>" + sign + "</i>" : sign;
}

std::string set_text(std::string_view text) {
  std::string html;
  int depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (text.substr(at).starts_with("&nbsp;")) {  // a number's unit: upright, up to its end
      const std::size_t end = std::min(text.find_first_of(" ,<)", at), text.size());
      html += text.substr(at, end - at);
      at = end;
      continue;
    }
    if (const std::size_t n = letters_from(text, at)) {
      html += set_letters(text.substr(at, n));
      at += n;
      continue;
    }
    depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    if (text[at] == '<') depth += text.substr(at).starts_with("</") ? -1 : 1;
    html += set_sign(text, at, depth);
  }
  return html;
}

void add_paragraph(std::string& html, std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n')) text.remove_suffix(1);
  if (text.empty()) return;
  // A point that only ended the sentence of the formula.
  if (text.size() == 1 && !html.empty() && std::ispunct(static_cast<unsigned char>(text[0])))
    return;
  html += "<p>" + std::string(text) + "</p>\n";
}

}  // namespace

std::string typeset_formula(std::string_view html) {
  std::string text = plain(html);
  while (!text.empty() && (text.back() == ' ' || text.back() == ',')) text.pop_back();
  return "<span class=eq>" + set_text(text) + "</span>";
}

std::string typeset_words(std::string_view words) {
  constexpr Entity kWords[] = {{"alpha", "α"}, {"beta", "β"}, {"mu", "μ"},  {"w2", "ω₂"},
                               {"w3", "ω₃"},   {"m2", "m²"},  {"s2", "s²"}, {"J2", "J²"}};
  std::string text;
  for (std::size_t at = 0; at < words.size();) {
    std::size_t n = 0;
    while (at + n < words.size() && std::isalnum(static_cast<unsigned char>(words[at + n])) != 0)
      ++n;
    const std::string_view word = words.substr(at, n);
    const auto sign = std::find_if(std::begin(kWords), std::end(kWords),
                                   [&](const Entity& e) { return e.name == word; });
    if (words.substr(at).starts_with("^2"))
      text += "²", n = 2;
    else if (sign != std::end(kWords))
      text += sign->text;
    else
      text += words.substr(at, n = std::max<std::size_t>(n, 1));
    at += n;
  }
  return escaped(text);
}

std::string typeset_statement(std::string_view statement) {
  std::string html;
  for (std::size_t at = 0; at < statement.size();) {
    const std::size_t open = statement.find("<p>", at);
    add_paragraph(html, statement.substr(at, open == std::string_view::npos ? open : open - at));
    if (open == std::string_view::npos) break;
    const std::size_t close = std::min(statement.find("</p>", open), statement.size());
    html += "<div class=formula>" + typeset_formula(statement.substr(open + 3, close - open - 3)) +
            "</div>\n";
    at = std::min(close + 4, statement.size());
  }
  return html;
}

}  // namespace twinarm::compare_page
