// A tree of XML elements with their attributes; text between elements is left out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

class StateArchive;

struct XmlAttribute {
  std::string name, value;
  int line = 0;
};

struct XmlElement {
  std::string name;
  int line = 0;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  const XmlAttribute* find(std::string_view attribute) const;  // or nullptr
  const char* value(std::string_view attribute) const;         // or nullptr
  const XmlElement* child(std::string_view name) const;        // the first, or nullptr
  // The children of this name.
  std::vector<const XmlElement*> all(std::string_view name) const;
};

// The root element. Throws InputError if the file is missing, larger than 16 MiB, not well-formed,
// without elements, or nested more than kMaxXmlDepth deep.
inline constexpr int kMaxXmlDepth = 100;
XmlElement read_xml(const std::filesystem::path& file);

// For the transfer between processes. Throws std::runtime_error if truncated or nested too deep.
void serialize(StateArchive& archive, XmlElement& element);

}  // namespace twinarm
