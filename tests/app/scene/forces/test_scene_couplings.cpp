// Every type of coupling of a scene: built, faulty, pulled apart into what is drawn and booked.
#include <Eigen/Geometry>

#include "app/scene/forces/scene_couplings.h"
#include "coupling/analysis/prediction.h"
#include "coupling/laws/coupling_spec.h"
#include "solver/stepping/simulation.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

const std::string kRobot =
    "[[robot]]\nname = 'r'\nmodel = 'robots/findings_set0/findings_set0.urdf'\n"
    "q = { joint1 = 1.5707963267948966, joint2 = -0.78539816339744831 }\n";

// The keys that a type must have.
std::string coupling_of(const std::string& type) {
  std::string text = "[[coupling]]\nname = 'c'\ntype = '" + type + "'\ntarget = 'paper'\n";
  // A couple on arm 2 would leave joint 1 alone.
  const bool at_point = type == "linear" || type == "bushing" || type == "weld" ||
                        type == "equivalent-torsional" || type == "published-linear";
  if (type != "god-object") text += at_point ? "link = 'arm2'\n" : "link = 'arm1'\n";
  if (type != "god-object" && type != "weld") text += "stiffness = 200\ndamping = 6\n";
  if (type == "bushing") text += "rotational_stiffness = 50\nrotational_damping = 2\n";
  return text;
}

struct Running {
  SceneModel scene;
  SceneCouplings couplings;
  Simulation simulation;
  explicit Running(const std::string& text)
      : scene(built(text)),
        couplings(scene, scene.description.step),
        simulation(scene.model, scene.start) {
    for (std::size_t c = 0; c < couplings.size(); ++c)
      if (ForceSource* source = couplings.source(c)) simulation.add(*source);
  }
};

TEST_CASE("scene: every type of coupling has a name, moves the robot and is one force source") {
  for (const CouplingFacts& facts : all_couplings) {
    CAPTURE(std::string(facts.name));
    Running run("gravity = [0, 0, 0]\n" + kRobot + coupling_of(facts.name));
    std::vector<std::string> names;
    std::size_t sources = 0;
    for (std::size_t c = 0; c < run.couplings.size(); ++c) {
      names.push_back(run.couplings.spec(c).name);
      sources += run.couplings.source(c) != nullptr;
    }
    CHECK(sources == 1);
    using Names = std::vector<std::string>;
    const std::string type = facts.name;
    if (type == "god-object")
      CHECK(names == Names{"c/joint1", "c/joint2"});
    else if (type == "bushing" || type == "weld")
      CHECK(names == Names{"c/force", "c/couple"});
    else
      CHECK(names == Names{"c"});
    for (int n = 0; n < 300; ++n) REQUIRE(run.simulation.step(1e-3).finite);
    // Joint 1 of the paper's motion has gone on from 90 degrees at -180 degrees per second; the
    // coupling has drawn it along.
    CHECK(run.simulation.state().q[0] < 1.5707963267948966 - 0.1);
    for (std::size_t c = 0; c < run.couplings.size(); ++c)
      if (type != "weld") CHECK(run.couplings.force(c).norm() > 0);
  }
}

TEST_CASE("scene: a run with any coupling resumes bit by bit") {
  for (const CouplingFacts& facts : all_couplings) {
    CAPTURE(std::string(facts.name));
    const std::string text =
        kRobot + coupling_of(facts.name) +
        (facts.can_hold
             ? "rate = 250\n" + std::string(facts.printed ? "" : "discretization = 'explicit'\n")
             : "");
    Running first(text), second(text);
    for (int n = 0; n < 101; ++n) first.simulation.step(1e-3);
    const State<double> aside = side_step(first.simulation, 5e-4);  // leaves no trace
    CHECK(aside.t > 0.101);
    StateArchive written;
    first.simulation.serialize(written);
    StateArchive read(written.bytes());
    second.simulation.serialize(read);
    for (int n = 0; n < 50; ++n) first.simulation.step(1e-3), second.simulation.step(1e-3);
    CHECK(first.simulation.state().q == second.simulation.state().q);
    CHECK(first.simulation.state().qd == second.simulation.state().qd);
    Running straight(text);
    for (int n = 0; n < 151; ++n) straight.simulation.step(1e-3);
    CHECK(first.simulation.state().q == straight.simulation.state().q);
  }
}

TEST_CASE("scene: force times velocity of any coupling is its power at the joints") {
  for (const CouplingFacts& facts : all_couplings) {
    CAPTURE(std::string(facts.name));
    SceneModel scene = built("gravity = [0, 0, 0]\n" + kRobot + coupling_of(facts.name));
    SceneCouplings couplings(scene, 1e-3);
    State<double> x = scene.start;
    x.qd[0] = 0.7, x.qd[1] = -1.3;
    x.q[0] += 0.2, x.q[1] -= 0.1;
    Kinematics k(scene.model);
    forward_kinematics(scene.model, x, k);
    Forces<double> forces(scene.model);
    couplings.source(0)->begin_step(k, 0, 1e-3);
    couplings.source(0)->add_forces(x, k, forces);
    double power = 0;  // of all wrenches and joint forces
    for (std::size_t dof = 0; dof < scene.model.nv; ++dof) power += forces.tau[dof] * x.qd[dof];
    for (std::size_t i = 1; i < scene.model.parent.size(); ++i) {
      const Vector3 n = k.R_WB[i] * to_eigen(forces.f_ext[i].n),
                    f = k.R_WB[i] * to_eigen(forces.f_ext[i].f);
      power += n.dot(k.w_WL[i]) + f.dot(k.v_WLo[i]);
    }
    double sum = 0;
    for (std::size_t c = 0; c < couplings.size(); ++c)
      sum += couplings.force(c).dot(couplings.ends(c, x, k).velocity);
    if (forces.has_added_inertia) {  // m* a_bias is added to the coupling force
      for (std::size_t i = 1; i < scene.model.parent.size(); ++i) {
        const Force<double> back = forces.added_inertia[i] * k.a_bias[i];
        power -= (k.R_WB[i] * to_eigen(back.n)).dot(k.w_WL[i]) +
                 (k.R_WB[i] * to_eigen(back.f)).dot(k.v_WLo[i]);
      }
    }
    CHECK(std::abs(power) > 0.1);
    CHECK(power == doctest::Approx(sum).epsilon(1e-12));
  }
}

}  // namespace
}  // namespace twinarm
