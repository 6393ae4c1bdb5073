// Files that are parsed in child processes: the same results and errors, and the parent lives on.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "collision/import/urdf/urdf.h"
#include "collision/import/urdf/xml_element.h"
#include "collision/sandbox/isolated_parser.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace fs = std::filesystem;
namespace {

class Isolated {
 public:
  Isolated() { isolate_parsers(); }
  ~Isolated() { isolate_parsers(false); }
};

std::string bytes_of(XmlElement element) {
  StateArchive archive;
  serialize(archive, element);
  return archive.bytes();
}

TEST_CASE("an isolated parser gives the same tree of each robot of the project") {
  int robots = 0;
  for (const auto& each :
       fs::recursive_directory_iterator(fs::path(TWINARM_SOURCE_DIR) / "assets")) {
    if (each.path().extension() != ".urdf") continue;
    const std::string direct = bytes_of(read_xml(each.path()));
    const Isolated isolated;
    CHECK(bytes_of(read_xml(each.path())) == direct);
    CHECK(bytes_of(read_xml(each.path())).size() > 300);
    ++robots;
  }
  CHECK(robots > 3);
}

TEST_CASE("an isolated parser reports the same errors with their lines and codes") {
  const TemporaryFolder folder;
  for (const char* text :
       {"<robot name='r'>\n<link", "", "<a/>", "<robot name='r'>\n<link a='1' a='2'/></robot>"}) {
    const auto file = folder.write("broken.urdf", text);
    const auto direct = faults_of([&] { read_urdf(file); });
    const Isolated isolated;
    const auto child = faults_of([&] { read_urdf(file); });
    REQUIRE(child.size() == direct.size());
    for (std::size_t k = 0; k < child.size(); ++k) {
      CHECK(to_string(child[k]) == to_string(direct[k]));
      CHECK(child[k].code == direct[k].code);
    }
  }
}

XmlElement crash(const std::string&, const std::string&) {
  std::abort();
}
XmlElement throw_unexpected(const std::string&, const std::string&) {
  throw std::logic_error("unexpected");
}
XmlElement take_too_long(const std::string&, const std::string&) {
  raise(SIGXCPU);  // what ends a parser that takes too long
  std::abort();
}

TEST_CASE("a parser that is taken over, crashes or never ends is an error of its file") {
  const Isolated isolated;
  for (const auto& faults : {faults_of([] { parse<crash>("x.urdf"); }),
                             faults_of([] { parse<throw_unexpected>("x.urdf"); }),
                             faults_of([] { parse<take_too_long>("x.urdf"); })}) {
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].file == "x.urdf");
    CHECK(faults[0].code == "parser.failed");
  }
}

TEST_CASE(
    "what a child that was taken over sends is refused unless it is a tree of bounded depth") {
  XmlElement deep;
  deep.name = "a";
  for (int k = 0; k < kMaxXmlDepth; ++k) deep = {"a", 1, {}, {deep}};
  std::string bytes = bytes_of(deep);
  XmlElement read;
  StateArchive whole(bytes);
  CHECK_NOTHROW(serialize(whole, read));
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    StateArchive cut(bytes.substr(0, length));
    CHECK_THROWS_AS(serialize(cut, read), std::runtime_error);
  }
  for (const std::size_t size_byte : {7, 20, 28}) {  // of the name, the attributes, the children
    std::string changed = bytes;
    changed[size_byte] = '\x7f';
    StateArchive huge(changed);
    CHECK_THROWS_AS(serialize(huge, read), std::runtime_error);
  }
  StateArchive deeper;
  deep = {"a", 1, {}, {deep}};
  CHECK_THROWS_AS(serialize(deeper, deep), std::runtime_error);
}

}  // namespace
}  // namespace twinarm
