// Invalid and suspicious URDF files: urdf_errors/NAME.urdf ends with a line for each error or
// warning, <!-- fault LINE CODE VALUE --> or <!-- warning LINE WORDS -->.
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

TEST_CASE("each invalid or suspicious URDF gives its errors or warnings in the order of lines") {
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(TWINARM_SOURCE_DIR "/tests/collision/import/urdf/urdf_errors")) {
    const fs::path file = entry.path();
    INFO(file.filename().string());
    const std::string text = text_of(file);
    std::vector<Diagnostic> warnings;
    const std::vector<Diagnostic> faults = faults_of([&] { warnings = read_urdf(file).warnings; });
    check_faults(faults, expected_in(text, "<!-- fault ", " -->"), file);
    check_faults(warnings, expected_in(text, "<!-- warning ", " -->"), file);
    for (const std::vector<Diagnostic>& reported : {faults, warnings})
      for (const Diagnostic& fault : reported) CHECK(!fault.fix.empty());
    ++files;
  }
  CHECK(files == 112);
}

TEST_CASE("malformed XML is one error") {
  const TemporaryFolder folder;
  const auto faults_in = [&](const std::string& text) {
    return faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
  };
  for (const std::string& text :
       {replaced(kGoodArm, "</robot>", ""), std::string(), std::string("no xml at all")})
    CHECK(faults_in(text).size() == 1);
  CHECK(tells(faults_in("<!-- nothing but words -->"), 0, "urdf.no-robot", ""));
}

TEST_CASE("a missing file, or a folder in its place, is an error with its name") {
  const TemporaryFolder folder;
  const auto faults = faults_of([&] { read_urdf(folder.path() / "none.urdf"); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].code == "file.missing");
  CHECK(faults[0].file == (folder.path() / "none.urdf").string());
  CHECK(faults_of([&] { read_urdf(folder.path()); }).size() == 1);
}

}  // namespace
}  // namespace twinarm
