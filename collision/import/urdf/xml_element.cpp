#include "collision/import/urdf/xml_element.h"

#include <tinyxml2.h>

#include <algorithm>
#include <stdexcept>

#include "collision/sandbox/isolated_parser.h"
#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"
#include "solver/support/text.h"

namespace twinarm {
namespace {

// "XML_ERROR_MISMATCHED_ELEMENT" -> "mismatched element"
std::string xml_error_text(const tinyxml2::XMLDocument& document) {
  std::string text = document.ErrorName();
  for (const char* prefix : {"XML_ERROR_", "XML_"})
    if (text.starts_with(prefix)) text.erase(0, std::string(prefix).size());
  std::replace(text.begin(), text.end(), '_', ' ');
  return lower_case(text);
}

// Recursion is bounded: tinyxml2 refuses deeper elements.
XmlElement element_of(const tinyxml2::XMLElement& from) {
  XmlElement element{from.Name(), from.GetLineNum(), {}, {}};
  for (const auto* a = from.FirstAttribute(); a; a = a->Next())
    element.attributes.push_back({a->Name(), a->Value(), a->GetLineNum()});
  for (const auto* e = from.FirstChildElement(); e; e = e->NextSiblingElement())
    element.children.push_back(element_of(*e));
  return element;
}

// Counts elements and attributes, with the same division into tags as tinyxml2, which compares
// each attribute with all before it in its element. Does not validate XML.
class XmlScan {
 public:
  explicit XmlScan(std::string_view text) : text_(text) {}

  // "" or what there is too much of; line() is then its line.
  std::string excess() {
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      if (pass("<!--", "-->") || pass("<![CDATA[", "]]>") || pass("<?", "?>") || pass("<!", ">"))
        continue;
      if (std::string problem = pass_element(); !problem.empty()) return problem;
    }
    return "";
  }
  int line() const { return 1 + static_cast<int>(std::ranges::count(text_.substr(0, at_), '\n')); }

 private:
  bool pass(std::string_view open, std::string_view close) {
    if (!text_.substr(at_).starts_with(open)) return false;
    at_ = std::min(text_.find(close, at_ + open.size()), text_.size() - close.size());
    at_ += close.size();
    return true;
  }
  std::string pass_element() {
    constexpr std::size_t kMaxAttributes = 1000, kMaxParts = 2000000;
    std::size_t attributes = 0;
    ++parts_;
    for (++at_; at_ < text_.size() && text_[at_] != '>'; ++at_) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') at_ = std::min(text_.find(c, at_ + 1), text_.size());
      if (c == '=' && ++attributes > kMaxAttributes)
        return "an element has more than 1000 attributes";
    }
    parts_ += attributes;
    return parts_ > kMaxParts ? "there are more than two million elements and attributes" : "";
  }

  std::string_view text_;
  std::size_t at_ = 0, parts_ = 0;
};

XmlElement parse_xml(const std::string& file, const std::string&) {
  const auto refuse = [&](int line, const std::string& problem, const std::string& fix,
                          std::string_view code) {
    throw InputError({{file, line, "", problem, fix, code}});
  };
  const std::string text = read_bounded_file(file, 16, "give a URDF file; store meshes separately");
  XmlScan scan(text);
  if (const std::string problem = scan.excess(); !problem.empty())
    refuse(scan.line(), problem, "give a URDF file; remove what is not of a robot",
           "urdf.too-many");
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    // If an end tag is missing, tinyxml2 gives the line of the start tag.
    const bool may_be_open = document.ErrorID() == tinyxml2::XML_ERROR_PARSING ||
                             document.ErrorID() == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT;
    refuse(document.ErrorLineNum(), "not well-formed XML: " + xml_error_text(document),
           may_be_open ? "correct the XML near this line, or close the element that begins "
                         "here (is there a </robot> at the end?)"
                       : "correct the XML at or shortly before this line",
           "urdf.xml");
  }
  if (!document.RootElement())
    refuse(0, "there is no <robot> element", "give a URDF file", "urdf.no-robot");
  return element_of(*document.RootElement());
}

void visit(StateArchive& archive, XmlElement& element, int depth) {
  if (depth > kMaxXmlDepth) throw std::runtime_error("XML is nested too deep");
  constexpr std::size_t kMinBytes = 20;  // of an element or attribute: two sizes and a line
  archive.visit(element.name, element.line);
  archive.resize(element.attributes, kMinBytes);
  for (XmlAttribute& a : element.attributes) archive.visit(a.name, a.value, a.line);
  archive.resize(element.children, kMinBytes);
  for (XmlElement& child : element.children) visit(archive, child, depth + 1);
}

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &XmlAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}
const char* XmlElement::value(std::string_view attribute) const {
  const XmlAttribute* const found = find(attribute);
  return found ? found->value.c_str() : nullptr;
}
const XmlElement* XmlElement::child(std::string_view wanted) const {
  const auto found = std::ranges::find(children, wanted, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}
std::vector<const XmlElement*> XmlElement::all(std::string_view wanted) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& each : children)
    if (each.name == wanted) found.push_back(&each);
  return found;
}

void serialize(StateArchive& archive, XmlElement& element) {
  visit(archive, element, 0);
}

XmlElement read_xml(const std::filesystem::path& file) {
  return parse<parse_xml>(file.string());
}

}  // namespace twinarm
