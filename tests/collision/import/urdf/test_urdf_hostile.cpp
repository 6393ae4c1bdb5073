// Hostile files: the reader rejects or reads them, and terminates.
#include <random>
#include <string>

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {
namespace {

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int k = 0; k < count; ++k) result += text;
  return result;
}

TEST_CASE("elements nested a hundred thousand deep are rejected") {
  const TemporaryFolder folder;
  for (const char* name : {"link", "gazebo", "geometry"}) {
    const std::string open = std::string("<") + name + ">", close = std::string("</") + name + ">";
    const std::string text = "<robot name=\"r\">" + repeated(open, 100000) +
                             repeated(close, 100000) + "<link name=\"a\"/></robot>";
    const auto faults = faults_of([&] { read_urdf(folder.write("deep.urdf", text)); });
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].problem == "not well-formed XML: element depth exceeded");
  }
}

TEST_CASE("more attributes than a robot has are rejected before the XML library sees them") {
  const TemporaryFolder folder;
  std::string attributes;
  for (int k = 0; k < 200000; ++k) attributes += " a" + std::to_string(k) + "='>'";
  const std::string comment = "<!-- <a" + attributes + "> -->\n<![CDATA[<a" + attributes + "]]>\n";
  for (const auto& [inside, line] : {std::pair("<link" + attributes + "/>", 1),
                                     std::pair(comment + "<link" + attributes + "/>", 3)}) {
    const std::string text = "<robot name='r'>" + inside + "</robot>";
    const auto faults = faults_of([&] { read_urdf(folder.write("wide.urdf", text)); });
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].problem == "an element has more than 1000 attributes");
    CHECK(faults[0].line == line);
  }
  const auto faults = faults_of([&] {
    read_urdf(folder.write(
        "many.urdf", "<robot name='r'>" + repeated("<a/>", 2000000) + "<link name='a'/></robot>"));
  });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].code == "urdf.too-many");
  CHECK(read_urdf(
            folder.write("comment.urdf", "<robot name='r'>" + comment + "<link name='a'/></robot>"))
            .links.size() == 1);
}

TEST_CASE("a chain of ten thousand links is read, in any order of the file") {
  const TemporaryFolder folder;
  constexpr int kLinks = 10000;
  std::string links, outward, inward;
  for (int k = 0; k < kLinks; ++k) {
    links += "<link name=\"" + std::to_string(k) + "\"/>\n";
    if (k == 0) continue;
    const std::string joint = "<joint name=\"" + std::to_string(k) +
                              "\" type=\"fixed\"><parent link=\"" + std::to_string(k - 1) +
                              "\"/><child link=\"" + std::to_string(k) + "\"/></joint>\n";
    outward += joint;
    inward = joint + inward;
  }
  for (const std::string& joints : {outward, inward}) {
    const RobotDescription robot =
        read_urdf(folder.write("chain.urdf", "<robot name=\"r\">" + links + joints + "</robot>"));
    CHECK(robot.root == "0");
    const auto order = joints_from_root(robot);
    REQUIRE(order.size() == kLinks - 1);
    CHECK(robot.joints[order.front()].child == "1");
    CHECK(robot.joints[order.back()].child == std::to_string(kLinks - 1));
  }
  const std::string closing =
      "<joint name=\"c\" type=\"fixed\"><parent link=\"9999\"/>"
      "<child link=\"0\"/></joint>";
  const std::string loop = "<robot name=\"r\">" + links + inward + closing + "</robot>";
  CHECK(faults_of([&] { read_urdf(folder.write("loop.urdf", loop)); }).size() == 1);
}

TEST_CASE("a value of a megabyte is rejected, and not repeated in full") {
  const TemporaryFolder folder;
  const std::string text =
      replaced(kGoodArm, "value=\"2\"", "value=\"" + repeated("9", 1000000) + "\"");
  const auto faults = faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
  REQUIRE(faults.size() == 1);
  CHECK(to_string(faults[0]).size() < 1000);
}

TEST_CASE("a file of more than 16 MiB is rejected before it is read") {
  const TemporaryFolder folder;
  const fs::path file = folder.write("big.urdf", kGoodArm);
  fs::resize_file(file, (16u << 20) + 1);  // sparse
  const auto faults = faults_of([&] { read_urdf(file); });
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].problem.find("16 MiB") != std::string::npos);
}

TEST_CASE(
    "a robot of more than forty thousand links and joints is rejected at the first excess one") {
  const TemporaryFolder folder;
  std::string text = "<robot name=\"crowd\">\n";
  for (int n = 0; n < 40001; ++n) text += "<link name=\"l" + std::to_string(n) + "\"/>\n";
  const auto faults = faults_of([&] { read_urdf(folder.write("crowd.urdf", text + "</robot>")); });
  INFO(listing(faults));
  CHECK(faults.size() == 1);
  CHECK(tells(faults, 40002, "urdf.too-many", "40,000"));
}

// Oracle: sanitizers, and the form of the errors.
TEST_CASE("a file with bytes exchanged, removed or duplicated is read or rejected") {
  const TemporaryFolder folder;
  std::string good = replaced(kGoodArm, "<axis",
                              "<mimic joint=\"joint1\"/><twinarm "
                              "type=\"screw\" pitch=\"0.1\"/><axis");
  good = replaced(good, "</geometry>",
                  "</geometry><material name=\"m\"><color rgba=\"1 1 1 1\"/>"
                  "</material>");
  std::mt19937 random(7);
  const std::string letters = "<>/\"= .-0123456789eExn&;\n";
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    std::string text = good;
    for (auto n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = random() % text.size(), length = random() % 20;
      switch (random() % 3) {
        case 0:
          text[at] = letters[random() % letters.size()];
          break;
        case 1:
          text.erase(at, length);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), length));
      }
    }
    const auto faults = faults_of([&] { read_urdf(folder.write("arm.urdf", text)); });
    refused += !faults.empty();
    for (const Diagnostic& fault : faults) CHECK(!fault.problem.empty());
  }
  CHECK(refused > 0);
}

}  // namespace
}  // namespace twinarm
