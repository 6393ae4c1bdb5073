// A scene: read, built, and run for two steps. Beside it lie a robot, a mesh and a trace, which it
// may name: arm.urdf, box.stl, hand.csv.
#include "app/run/run.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

constexpr const char* kArm = R"(<robot name="arm"><link name="base"/>
<link name="upper"><inertial><origin xyz="0 0 0.2"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.001"/></inertial><collision><origin xyz="0 0 0.2"/><geometry><box size="0.05 0.05 0.4"/></geometry></collision></link>
<link name="lower"><inertial><origin xyz="0 0 0.2"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.001"/></inertial></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="9" velocity="9"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/></joint>
</robot>)";
constexpr const char* kBox = R"(solid box
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 1 0 vertex 1 0 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet
facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet
facet normal 0 0 0 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet
endsolid box
)";
constexpr const char* kHand =
    "t[s],theta1[rad],theta2[rad],theta3[rad],theta4[rad],theta5[rad],theta6[rad],button\n"
    "0,0,0.7,0.2,0,0.6,0,0\n0.5,0.1,0.7,0.2,0,0.6,0,0\n1,0.1,0.8,0.2,0,0.6,0,1\n";

}  // namespace

void scene(Bytes bytes) {
  [[maybe_unused]] static const auto beside = {folder().write("arm.urdf", kArm),
                                               folder().write("box.stl", kBox),
                                               folder().write("hand.csv", kHand)};
  SimulateOptions options;
  options.robot.model = folder().write("scene.toml", bytes);
  options.duration = 1;
  goes_through([&] {
    const SimulatePlan plan = prepare_simulation(options);
    RunWatch watch;
    RunStart start;
    start.anew = true;
    start.last_step = 2;
    run_plan(plan.input, plan.run, watch, &start);
  });
}

}  // namespace twinarm::fuzz
