// Bad and odd URDF files, each with what is to be said of it: urdf_errors/NAME.urdf ends with a
// line for each fault or warning, <!-- fault LINE CODE VALUE --> or <!-- warning LINE WORDS -->.
#include <algorithm>
#include <sstream>

#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

struct ExpectedFault {
  int line = 0;
  std::string code, words;  // in the fault or warning; a warning has no code
};

std::vector<ExpectedFault> expected_in(const std::string& text, const std::string& kind) {
  std::vector<ExpectedFault> found;
  std::istringstream lines(text);
  const std::string start = "<!-- " + kind + " ", end = " -->";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(start, 0) != 0) continue;
    std::istringstream words(line.substr(start.size(), line.size() - start.size() - end.size()));
    ExpectedFault& one = found.emplace_back();
    words >> one.line;
    if (kind == "fault") words >> one.code;
    std::getline(words >> std::ws, one.words);
  }
  return found;
}

void check(const std::vector<Fault>& faults, const std::vector<ExpectedFault>& expected,
           const fs::path& file) {
  INFO(listing(faults));
  CHECK(faults.size() == expected.size());
  for (const ExpectedFault& one : expected)
    CHECK(std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
      return fault.line == one.line && (one.code.empty() || fault.code == one.code) &&
             to_string(fault).find(one.words) != std::string::npos;
    }));
  for (const Fault& fault : faults) {
    CHECK(fault.file == file.string());
    CHECK(!fault.rule.empty());
    CHECK(!fault.remedy.empty());
  }
  CHECK(std::is_sorted(faults.begin(), faults.end(),
                       [](const Fault& a, const Fault& b) { return a.line < b.line; }));
}

TEST_CASE("each bad or odd URDF gives its faults or warnings, in the order of the lines") {
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(TWINARM_SOURCE_DIR "/tests/collision/import/urdf/urdf_errors")) {
    const fs::path file = entry.path();
    INFO(file.filename().string());
    const std::string text = text_of(file);
    std::vector<Fault> warnings;
    check(faults_of([&] { warnings = read_urdf(file).warnings; }), expected_in(text, "fault"),
          file);
    check(warnings, expected_in(text, "warning"), file);
    ++files;
  }
  CHECK(files == 111);
}

TEST_CASE("malformed XML is one fault") {
  const TemporaryFolder folder;
  const auto faults_in = [&](const std::string& text) {
    return faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
  };
  for (const std::string& text :
       {replaced(kGoodArm, "</robot>", ""), std::string(), std::string("no xml at all")})
    CHECK(faults_in(text).size() == 1);
  CHECK(tells(faults_in("<!-- nothing but words -->"), 0, "urdf.no-robot", ""));
}

TEST_CASE("a missing file, or a folder in its place, is a fault with its name") {
  const TemporaryFolder folder;
  const auto faults = faults_of([&] { read_urdf(folder.path() / "none.urdf"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].code == "file.missing");
  CHECK(faults[0].file == (folder.path() / "none.urdf").string());
  CHECK(faults_of([&] { read_urdf(folder.path()); }).size() == 1);
}

}  // namespace
}  // namespace twinarm
