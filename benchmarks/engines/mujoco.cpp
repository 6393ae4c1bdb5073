// MuJoCo.
//
// header: mujoco/mujoco.h
// libraries: mujoco
//
// Scenes: mj_step with each of its integrators; contacts by Newton's method (also by CG, for
// bench_contact) and elliptic cones, otherwise defaults. It has no coefficient of restitution.
//
// Algorithms: smooth dynamics, by only those calls of mj_forward that the result requires. No
// collision, constraints, actuators or passive forces (the models have none, and mj_passive would
// only add time): the minimum time of MuJoCo for the result.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

// With all digits, each followed by a space.
template <class Numbers>
std::string mjcf(const Numbers& numbers) {
  std::ostringstream out;
  out.precision(17);
  for (const double number : numbers) out << number << ' ';
  return out.str();
}

struct MujocoRun {
  struct Release {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Release> model;
  std::unique_ptr<mjData, Release> data;

  MujocoRun() = default;
  // From files in memory, names and texts; the model is last.
  explicit MujocoRun(const std::vector<std::pair<std::string, std::string>>& files) {
    // avoids a log file
    mju_user_warning = [](const char* what) { std::cerr << "MuJoCo warns: " << what << '\n'; };
    const auto disk = std::make_unique<mjVFS>();
    mj_defaultVFS(disk.get());
    for (const auto& [name, xml] : files) {
      mj_makeEmptyFileVFS(disk.get(), name.c_str(), static_cast<int>(xml.size()));
      std::copy(xml.begin(), xml.end(), static_cast<char*>(disk->filedata[disk->nfile - 1]));
    }
    char fault[500] = "";
    model.reset(mj_loadXML(files.back().first.c_str(), disk.get(), fault, sizeof fault));
    mj_deleteVFS(disk.get());
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    data.reset(mj_makeData(model.get()));
  }
};

// The scene as MJCF. The XML reader rejects elements nested deeper than 100; deeper bodies are
// written to separate files, each included at its first body.
class Mjcf {
 public:
  Mjcf(const Scene& scene, const std::string& integrator, double h,
       const std::string& solver = "Newton")
      : scene_(scene) {
    const std::size_t contacts = std::max<std::size_t>(1000, 10 * scene.bodies.size());
    std::string xml =
        "<mujoco><compiler angle=\"radian\"/><size njmax=\"" + std::to_string(3 * contacts) +
        "\" nconmax=\"" + std::to_string(contacts) + "\"/><option timestep=\"" +
        mjcf(std::array{h}) + "\" gravity=\"" + mjcf(scene.gravity) + "\" integrator=\"" +
        integrator + "\" solver=\"" + solver + "\" cone=\"elliptic\">" +
        (scene.has_contacts() ? "" : "<flag constraint=\"disable\" contact=\"disable\"/>") +
        "</option><worldbody>";
    // Friction of a pair is the maximum, unless one surface has priority.
    if (scene.floor)
      xml += "<geom type=\"plane\" size=\"50 50 1\" priority=\"1\"" + surface(scene.floor_friction);
    xml += children(-1, 1);
    for (const Scene::FixedBox& box : scene.fixed_boxes)
      xml += "<geom type=\"box\" pos=\"" + mjcf(box.centre) + "\" size=\"" + mjcf(box.half) + "\"" +
             surface(scene.friction);
    files.emplace_back("model.xml", xml + "</worldbody></mujoco>");
  }
  std::vector<std::pair<std::string, std::string>> files;  // name and text; the model is last

 private:
  static std::string surface(double friction) {
    return std::string(" condim=\"") + (friction > 0 ? '3' : '1') + "\" friction=\"" +
           mjcf(std::array{friction}) + "\"/>";
  }
  std::string children(int parent, int depth) {
    std::string xml;
    for (auto i = static_cast<std::size_t>(parent + 1); i < scene_.bodies.size(); ++i) {
      if (scene_.bodies[i].parent != parent) continue;
      if (depth % 80 != 0) {
        xml += body(i, depth);
        continue;
      }
      const std::string name = "from" + std::to_string(i) + ".xml";
      const std::string part = "<mujocoinclude>" + body(i, depth) + "</mujocoinclude>";
      files.emplace_back(name, part);
      xml += "<include file=\"" + name + "\"/>";
    }
    return xml;
  }
  std::string body(std::size_t i, int depth) {
    const Body& b = scene_.bodies[i];
    const Eigen::Quaterniond R(b.rotation);
    std::string xml = "<body pos=\"" + mjcf(b.position) + "\" quat=\"" +
                      mjcf(std::array{R.w(), R.x(), R.y(), R.z()}) + "\">";
    if (b.joint == Joint::free)
      xml += "<freejoint/>";
    else if (b.joint == Joint::spherical)
      xml += "<joint type=\"ball\"/>";
    else
      xml += "<joint type=\"hinge\" axis=\"" + mjcf(axis_of(b)) + "\"/>";
    xml += "<inertial pos=\"" + mjcf(b.com) + "\" mass=\"" + mjcf(std::array{b.mass}) +
           "\" fullinertia=\"" + mjcf(b.inertia) + "\"/>";
    if (b.form != Form::none)
      xml += std::string("<geom type=\"") + (b.form == Form::box ? "box" : "sphere") +
             "\" size=\"" + mjcf(b.half) + "\" pos=\"" + mjcf(b.form_at) + "\"" +
             surface(scene_.friction);
    return xml + children(static_cast<int>(i), depth + 1) + "</body>";
  }
  const Scene& scene_;
};

// Situations are converted to the order of MuJoCo's coordinates.
class MuJoCo final : public PeerEngine<Situation> {
 public:
  std::string name() const override { return "mujoco"; }
  std::vector<Scheme> schemes(const Scene&) const override {
    return {{"Euler"}, {"RK4"}, {"implicit"}};
  }
  std::string refusal(const Scene& scene) const override {
    return scene.restitution > 0 ? "MuJoCo has no coefficient of restitution" : "";
  }
  std::vector<Scheme> contact_schemes(const Scene&) const override {
    return {{"Euler"}, {kConjugate}};
  }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(scene, h);
    run_ = scheme.name == kConjugate ? MujocoRun(Mjcf(scene, "Euler", h, "CG").files)
                                     : MujocoRun(Mjcf(scene, scheme.name, h).files);
    std::copy(scene.q.begin(), scene.q.end(), data()->qpos);
    const std::vector<double> v = swapped(scene.v);
    std::copy(v.begin(), v.end(), data()->qvel);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      std::copy_n(scene.bodies[i].push.data(), 3, data()->xfrc_applied + 6 * (i + 1));
  }
  void step() override {
    mjData* d = data();
    if (scene_.control)
      for (std::size_t j = 0; j < scene_.bodies.size(); ++j)
        d->qfrc_applied[j] = scene_.control->torque(j, d->qpos[j], d->qvel[j]);
    mj_step(run_.model.get(), d);
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q.assign(data()->qpos, data()->qpos + run_.model->nq);
    v = of_velocities(data()->qvel);
  }

  // It stores principal axes of inertia as a quaternion, found by iteration to about 1e-8: with
  // inertias that are not diagonal its mechanism differs by that much.
  double tolerance(const Scene& mechanism) const override {
    const bool diagonal = std::all_of(
        mechanism.bodies.begin(), mechanism.bodies.end(),
        [](const Body& b) { return b.inertia[3] == 0 && b.inertia[4] == 0 && b.inertia[5] == 0; });
    return diagonal ? 1e-9 : 1e-6;
  }
  bool has(Algorithm algorithm) const override { return algorithm <= Algorithm::derivatives; }
  // Bodies are in depth-first order, as in all the mechanisms.
  void load_mechanism(const Scene& mechanism) override {
    scene_ = mechanism;
    run_ = MujocoRun(Mjcf(mechanism, "Euler", step_length).files);
    const auto nv = static_cast<std::size_t>(run_.model->nv);
    identity_.assign(nv * nv, 0), inverse_.resize(nv * nv), rates_.resize(6 * nv * nv);
    for (std::size_t k = 0; k < nv; ++k) identity_[k * (nv + 1)] = 1;
  }
  std::vector<double> qdd(std::size_t k) override {
    run_one(Algorithm::forward_dynamics, converted_[k]);
    return of_velocities(data()->qacc_smooth);
  }
  std::vector<double> tau(std::size_t k) override {
    run_one(Algorithm::inverse_dynamics, converted_[k]);
    return of_velocities(data()->qfrc_inverse);
  }

 private:
  mjData* data() const { return run_.data.get(); }

  // Coordinates as in the scene, except that the linear velocity of a free body is first.
  std::vector<double> swapped(std::vector<double> v) const {
    auto at = v.begin();
    for (const Body& b : scene_.bodies) {
      if (b.joint == Joint::free) std::swap_ranges(at, at + 3, at + 3);
      at += static_cast<std::ptrdiff_t>(velocities_of(b.joint));
    }
    return v;
  }
  std::vector<double> of_velocities(const mjtNum* v) const {
    return swapped({v, v + run_.model->nv});
  }

  Situation convert(const Situation& s) const override {
    return {s.q, swapped(s.v), swapped(s.tau), swapped(s.qdd)};
  }
  void run_one(Algorithm algorithm, const Situation& s) override {
    const mjModel* m = run_.model.get();
    mjData* d = data();
    std::copy(s.q.begin(), s.q.end(), d->qpos);
    if (algorithm != Algorithm::mass_matrix && algorithm != Algorithm::kinematics)
      std::copy(s.v.begin(), s.v.end(), d->qvel);
    switch (algorithm) {
      case Algorithm::forward_dynamics:
        position(m, d);
        mj_crb(m, d);
        mj_factorM(m, d);
        mj_comVel(m, d);
        mj_rne(m, d, 0, d->qfrc_bias);
        for (std::size_t i = 0; i < s.tau.size(); ++i)
          d->qfrc_smooth[i] = s.tau[i] - d->qfrc_bias[i];
        mj_solveM(m, d, d->qacc_smooth, d->qfrc_smooth, 1);
        break;
      case Algorithm::inverse_dynamics:
        position(m, d);
        mj_comVel(m, d);
        std::copy(s.qdd.begin(), s.qdd.end(), d->qacc);
        mj_rne(m, d, 1, d->qfrc_inverse);
        break;
      case Algorithm::mass_matrix:  // sparse, as MuJoCo uses it
        position(m, d);
        mj_crb(m, d);
        break;
      case Algorithm::kinematics:
        mj_kinematics(m, d);
        break;
      case Algorithm::step:  // a complete step: MuJoCo offers no smaller one
        std::copy(s.tau.begin(), s.tau.end(), d->qfrc_applied);
        mj_step(m, d);
        break;
      case Algorithm::inverse_mass_matrix:
        position(m, d);
        mj_crb(m, d);
        mj_factorM(m, d);
        mj_solveM(m, d, inverse_.data(), identity_.data(), m->nv);
        break;
      case Algorithm::derivatives:  // of a step, by forward differences
        std::copy(s.tau.begin(), s.tau.end(), d->qfrc_applied);
        mjd_transitionFD(m, d, 1e-6, 0, rates_.data(), nullptr, nullptr, nullptr);
        break;
      case Algorithm::constrained_dynamics:  // its constraints are soft
        break;
    }
  }
  static constexpr const char* kConjugate = "CG";  // Euler, contacts by conjugate gradients

  static void position(const mjModel* m, mjData* d) {
    mj_kinematics(m, d);
    mj_comPos(m, d);  // also computes the com-based inertias and motion axes of crb and rne
  }

  MujocoRun run_;
  std::vector<mjtNum> identity_, inverse_, rates_;
};

}  // namespace

EngineKind mujoco_engine() {
  return {"mujoco", 1, one_engine<MuJoCo>};
}

}  // namespace twinarm::bench
