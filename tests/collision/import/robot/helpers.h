// Helpers of collision/import tests: comparison of robots, errors.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"
#include "tests/support/temporary_folder.h"

namespace twinarm {

inline std::vector<Diagnostic> faults_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

inline std::string listing(const std::vector<Diagnostic>& faults) {
  std::string text;
  for (const Diagnostic& fault : faults) text += to_string(fault) + "\n";
  return text;
}

// Whether there is an error at this line whose text contains `words`.
inline bool tells(const std::vector<Diagnostic>& faults, int line, const std::string& words) {
  for (const Diagnostic& fault : faults)
    if (fault.line == line && to_string(fault).find(words) != std::string::npos) return true;
  return false;
}

// As above with an error code; `value` is a text from the user's file.
inline bool tells(const std::vector<Diagnostic>& faults, int line, const std::string& code,
                  const std::string& value) {
  for (const Diagnostic& fault : faults)
    if (fault.line == line && fault.code == code &&
        to_string(fault).find(value) != std::string::npos)
      return true;
  return false;
}

// Expectations in a file of invalid input: START LINE CODE WORDS END, or START LINE WORDS END of a
// warning. The words are in the message; - is any code.
struct ExpectedFault {
  int line = 0;
  std::string code, words;
};

inline std::vector<ExpectedFault> expected_in(const std::string& text, const std::string& start,
                                              const std::string& end) {
  std::vector<ExpectedFault> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(start, 0) != 0) continue;
    std::istringstream words(line.substr(start.size(), line.size() - start.size() - end.size()));
    ExpectedFault& one = found.emplace_back();
    words >> one.line;
    if (start.find("fault") != std::string::npos) words >> one.code;
    std::getline(words >> std::ws, one.words);
  }
  return found;
}

// Exactly these errors, in the order of lines.
inline void check_faults(const std::vector<Diagnostic>& faults,
                         const std::vector<ExpectedFault>& expected, const fs::path& file) {
  INFO(listing(faults));
  CHECK(faults.size() == expected.size());
  for (const ExpectedFault& one : expected)
    CHECK(std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& fault) {
      return fault.line == one.line &&
             (one.code.empty() || one.code == "-" || fault.code == one.code) &&
             to_string(fault).find(one.words) != std::string::npos;
    }));
  for (const Diagnostic& fault : faults) {
    CHECK(fault.file == file.string());
    CHECK(!fault.problem.empty());
  }
  CHECK(std::is_sorted(faults.begin(), faults.end(),
                       [](const Diagnostic& a, const Diagnostic& b) { return a.line < b.line; }));
}

// Maximum difference of two numbers or arrays relative to the size of the array; tolerance 0:
// bit-identical (0 and -0 differ).
inline bool same(double a, double b, double tolerance) {
  if (tolerance == 0) return a == b && std::signbit(a) == std::signbit(b);
  return std::abs(a - b) <= tolerance * std::max(1.0, std::abs(b));
}
template <class M>
bool same(const Eigen::MatrixBase<M>& a, const Eigen::MatrixBase<M>& b, double tolerance) {
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      if (!same(a(i, j), b(i, j), tolerance)) return false;
  return true;
}

inline void check_same(const ShapeDescription& a, const ShapeDescription& b, double tolerance) {
  REQUIRE(a.index() == b.index());
  std::visit(
      [&](const auto& shape) {
        using S = std::decay_t<decltype(shape)>;
        if constexpr (requires { S::lengths(); })
          std::apply(
              [&](const auto&... of) {
                (CHECK(same(shape.*of.second, std::get<S>(b).*of.second, tolerance)), ...);
              },
              S::lengths());
      },
      a);
  if (const auto* mesh = std::get_if<MeshGeometry>(&a)) {
    CHECK(mesh->file == std::get<MeshGeometry>(b).file);
    if (mesh->file.empty()) CHECK(mesh->name == std::get<MeshGeometry>(b).name);
    CHECK(same(mesh->scale, std::get<MeshGeometry>(b).scale, tolerance));
  }
}

template <class Part>
void check_same_part(const Part& a, const Part& b, double tolerance) {
  CHECK(a.name == b.name);
  CHECK(same(a.origin.xyz, b.origin.xyz, tolerance));
  CHECK(same(a.origin.rpy, b.origin.rpy, tolerance));
  check_same(a.geometry, b.geometry, tolerance);
}

inline void check_same(const LinkDescription& a, const LinkDescription& b, double tolerance) {
  INFO("link ", a.name);
  CHECK(a.name == b.name);
  CHECK(a.has_inertia == b.has_inertia);
  CHECK(same(a.mass, b.mass, tolerance));
  CHECK(same(a.com, b.com, tolerance));
  CHECK(same(a.inertia, b.inertia, tolerance));
  REQUIRE(a.visuals.size() == b.visuals.size());
  for (std::size_t i = 0; i < a.visuals.size(); ++i) {
    check_same_part(a.visuals[i], b.visuals[i], tolerance);
    CHECK(a.visuals[i].material == b.visuals[i].material);
    CHECK(same(a.visuals[i].color, b.visuals[i].color, tolerance));
    CHECK(a.visuals[i].texture == b.visuals[i].texture);
    if (a.visuals[i].texture.empty()) CHECK(a.visuals[i].texture_name == b.visuals[i].texture_name);
  }
  REQUIRE(a.collisions.size() == b.collisions.size());
  for (std::size_t i = 0; i < a.collisions.size(); ++i)
    check_same_part(a.collisions[i], b.collisions[i], tolerance);
}

inline void check_same(const JointDescription& a, const JointDescription& b, double tolerance) {
  INFO("joint ", a.name);
  CHECK(a.name == b.name);
  CHECK(a.type == b.type);
  CHECK(a.parent == b.parent);
  CHECK(a.child == b.child);
  CHECK(same(a.origin.xyz, b.origin.xyz, tolerance));
  CHECK(same(a.origin.rpy, b.origin.rpy, tolerance));
  CHECK(same(a.axis, b.axis, tolerance));
  CHECK(same(a.pitch, b.pitch, tolerance));
  CHECK(same(a.lower, b.lower, tolerance));
  CHECK(same(a.upper, b.upper, tolerance));
  CHECK(same(a.effort, b.effort, tolerance));
  CHECK(same(a.velocity, b.velocity, tolerance));
  CHECK(same(a.damping, b.damping, tolerance));
  CHECK(same(a.friction, b.friction, tolerance));
  CHECK(same(a.armature, b.armature, tolerance));
  CHECK(same(a.coulomb_plus, b.coulomb_plus, tolerance));
  CHECK(same(a.coulomb_minus, b.coulomb_minus, tolerance));
  REQUIRE(a.mimic.has_value() == b.mimic.has_value());
  if (!a.mimic) return;
  CHECK(a.mimic->joint == b.mimic->joint);
  CHECK(same(a.mimic->multiplier, b.mimic->multiplier, tolerance));
  CHECK(same(a.mimic->offset, b.mimic->offset, tolerance));
}

// All fields except lines, warnings and file name.
inline void check_same(const RobotDescription& a, const RobotDescription& b, double tolerance) {
  CHECK(a.name == b.name);
  CHECK(a.root == b.root);
  REQUIRE(a.links.size() == b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) check_same(a.links[i], b.links[i], tolerance);
  REQUIRE(a.joints.size() == b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) check_same(a.joints[i], b.joints[i], tolerance);
}

// A valid arm with one revolute joint. The first line is <robot>.
inline const char* const kGoodArm = R"(<robot name="arm">
  <link name="base"/>
  <link name="arm1">
    <inertial>
      <origin xyz="0.2 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/>
    </inertial>
    <visual>
      <geometry><box size="0.4 0.1 0.1"/></geometry>
    </visual>
  </link>
  <joint name="joint1" type="revolute">
    <parent link="base"/>
    <child link="arm1"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1.5" effort="10" velocity="5"/>
    <dynamics damping="0.1" friction="0.2"/>
  </joint>
</robot>
)";

}  // namespace twinarm
