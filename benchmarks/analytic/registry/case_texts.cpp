#include "benchmarks/analytic/registry/case_texts.h"

#include <sstream>
#include <vector>

#include "benchmarks/analytic/registry/case_sources.h"

namespace twinarm {
namespace {

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream in(list);
  for (std::string name; std::getline(in >> std::ws, name, ',');) names.push_back(name);
  return names;
}

// A line that begins with spaces goes on with the one before.
std::string with_lines_joined(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;)
    text.replace(at, 3, " ");
  return text;
}

void read_group(const CaseSource& document, std::map<std::string, CaseText>& texts) {
  const std::string group(document.file.substr(0, document.file.find('.')));
  std::string statement;
  bool ended = true;  // the paragraph, by an empty line
  std::istringstream in(with_lines_joined(std::string(document.text)));
  for (std::string line; std::getline(in, line); ended = line.empty()) {
    if (line.starts_with("- ")) {
      const std::size_t colon = line.find(": ");
      for (const std::string& name : names_in(line.substr(2, colon - 2)))
        texts[name] = {group, line.substr(colon + 2), statement};
    } else if (!line.empty()) {
      statement = ended ? line : statement + " " + line;
    }
  }
}

}  // namespace

const std::map<std::string, CaseText>& case_texts() {
  static const std::map<std::string, CaseText> all = [] {
    std::map<std::string, CaseText> texts;
    for (const CaseSource& document : case_documents()) read_group(document, texts);
    return texts;
  }();
  return all;
}

}  // namespace twinarm
