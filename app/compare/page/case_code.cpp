#include "app/compare/page/case_code.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include "benchmarks/analytic/registry/case_sources.h"

namespace twinarm::compare_page {
namespace {

bool in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Without comments and what stands in quotes.
std::string bare(std::string_view text) {
  std::string all;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i).starts_with("//")) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
      continue;
    }
    if (i < text.size()) all += text[i];
  }
  return all;
}

std::set<std::string> names_in(std::string_view code) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < code.size();) {
    std::size_t n = 0;
    while (i + n < code.size() && in_name(code[i + n])) ++n;
    if (n > 0) names.emplace(code.substr(i, n));
    i += std::max<std::size_t>(n, 1);
  }
  return names;
}

struct Definition {
  std::string text;
  std::set<std::string> defines, uses;
};

// A function is named before its first bracket; of variables there may be several.
std::set<std::string> defined_in(const std::string& code) {
  const auto name_before = [&](std::size_t end) {
    while (end > 0 && std::string_view(" []").find(code[end - 1]) != std::string_view::npos) --end;
    std::size_t begin = end;
    while (begin > 0 && in_name(code[begin - 1])) --begin;
    return code.substr(begin, end - begin);
  };
  for (const std::string_view kind : {"struct ", "enum class ", "class "})
    if (code.starts_with(kind))
      return {code.substr(kind.size(), code.find_first_of(" {:", kind.size()) - kind.size())};
  const std::size_t stop = code.find_first_of("(={");
  if (stop == std::string::npos) return {};
  if (code[stop] != '=') return {name_before(stop)};
  std::set<std::string> names;
  for (std::size_t at = code.find(" ="); at != std::string::npos; at = code.find(" =", at + 1))
    if (code[at + 2] != '=') names.insert(name_before(at));
  return names;
}

// Comments and `template` lines belong to what follows them.
std::vector<Definition> definitions_of(std::string_view source) {
  std::vector<std::string> chunks;
  bool open = false;  // the last chunk waits for its definition
  for (std::size_t at = 0; at < source.size();) {
    const std::size_t end = std::min(source.find('\n', at), source.size());
    const std::string line(source.substr(at, end - at));
    at = end + 1;
    const auto starts = [&](std::string_view what) { return line.starts_with(what); };
    if (line.empty()) {
      if (open) chunks.emplace_back();
      open = false;
    } else if (starts("#") || starts("namespace") || starts("}  // namespace") ||
               starts("using namespace")) {
      chunks.emplace_back();
      open = false;
    } else if (line[0] == ' ' || line[0] == '}') {
      if (!chunks.empty()) chunks.back() += line + "\n";
    } else {
      if (!open) chunks.emplace_back();
      chunks.back() += line + "\n";
      open = starts("//") || starts("template");
    }
  }
  std::vector<Definition> all;
  for (std::string& text : chunks) {
    const std::string code = bare(text);
    if (names_in(code).empty()) continue;
    all.push_back({text, defined_in(code), names_in(code)});
  }
  return all;
}

// The brackets around `at`, with the name before them and its template arguments; a call that only
// makes the name does not count.
std::string_view around(std::string_view text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i-- > 0;) {
    depth += text[i] == ')' || text[i] == '}' ? 1 : text[i] == '(' || text[i] == '{' ? -1 : 0;
    if (depth >= 0) continue;
    depth = 0;
    std::size_t begin = i, end = i;
    if (begin > 0 && text[begin - 1] == '>') begin = text.rfind('<', begin);
    while (begin > 0 && in_name(text[begin - 1])) --begin;
    if (text.substr(begin, i - begin) == "name_of_case") continue;
    for (int inner = 0; end < text.size(); ++end) {
      inner += text[end] == '(' || text[end] == '{'   ? 1
               : text[end] == ')' || text[end] == '}' ? -1
                                                      : 0;
      if (inner == 0) break;
    }
    return text.substr(begin, std::min(end + 1, text.size()) - begin);
  }
  return {};
}

// The name may be put together from a beginning that ends with a hyphen.
std::pair<const CaseSource*, std::size_t> find_case(std::string name) {
  for (; name.size() >= 2; name.pop_back()) {
    const std::string quoted = "\"" + name + "\"";
    for (const CaseSource& source : case_sources()) {
      if (source.file.ends_with("_statements.cpp") || source.file.ends_with("analytic_cases.cpp"))
        continue;
      std::size_t at = source.text.find(quoted), last = at;
      // The mechanism's own name may stand before; what registers comes last.
      for (; at != std::string_view::npos; at = source.text.find(quoted, at + 1)) last = at;
      if (last != std::string_view::npos &&
          source.text.find("std::vector<AnalyticCase>") != std::string_view::npos)
        return {&source, last};
    }
  }
  return {nullptr, 0};
}

// Definitions of other files that a case is made of; the common parts are told by their headers.
const Definition* elsewhere(const std::string& name, const std::string_view but) {
  static const auto all = [] {
    std::vector<std::pair<std::string_view, std::vector<Definition>>> files;
    for (const CaseSource& source : case_sources())
      if (source.file.starts_with("loops/"))
        files.emplace_back(source.file, definitions_of(source.text));
    return files;
  }();
  for (const auto& [file, definitions] : all)
    for (const Definition& d : definitions)
      if (file != but && d.defines.count(name)) return &d;
  return nullptr;
}

// What the function that makes the list has of its own, up to the line: `const auto small = ..`.
std::vector<Definition> locals_before(std::string_view source, std::size_t at) {
  const std::size_t begin = source.rfind("\nstd::vector<AnalyticCase>", at);
  if (begin == std::string_view::npos) return {};
  const std::size_t body = source.find('\n', begin + 1) + 1;
  std::string all;
  for (std::size_t i = body; i < at;) {
    const std::size_t end = std::min(source.find('\n', i), at);
    const std::string_view line = source.substr(i, end - i);
    if (line.starts_with("  return")) break;
    all += std::string(line.starts_with("  ") ? line.substr(2) : line) + "\n";
    i = end + 1;
  }
  return definitions_of(all);
}

}  // namespace

CaseCode code_of(const std::string& case_name) {
  const auto [source, at] = find_case(case_name);
  if (!source) return {};
  const std::string_view line = around(source->text, at);
  std::vector<Definition> all = definitions_of(source->text);
  for (Definition& local : locals_before(source->text, at)) all.push_back(std::move(local));
  std::vector<bool> wanted(all.size(), false);
  std::vector<std::string> open;
  std::string from_elsewhere;
  for (const std::string& name : names_in(bare(line))) {
    open.push_back(name);
    if (const Definition* other = elsewhere(name, source->file)) {
      from_elsewhere += other->text + "\n";
    }
  }
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (wanted[i] || !all[i].defines.count(name)) continue;
      if (all[i].text.starts_with("std::vector<AnalyticCase>")) continue;
      wanted[i] = true;
      open.insert(open.end(), all[i].uses.begin(), all[i].uses.end());
    }
  }
  CaseCode code{"benchmarks/analytic/" + std::string(source->file), from_elsewhere};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (wanted[i]) code.text += all[i].text + "\n";
  code.text += "// The line of the list:\n" + std::string(line) + "\n";
  return code;
}

}  // namespace twinarm::compare_page
