// MuJoCo. What is timed is its smooth dynamics: the calls of mj_forward that the answer needs, and
// no other. No collision, no constraints, no actuators, no passive forces (the models have none,
// and mj_passive would only cost), so this is the least time in which MuJoCo itself can give it.
#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "benchmarks/speed/eigen.h"
#include "benchmarks/speed/engine.h"
#include "benchmarks/speed/mujoco_model.h"

namespace twinarm::speed {
namespace {

// The mechanism as MJCF. The XML reader refuses elements nested deeper than 100, so what hangs
// lower goes into files of its own, each included where its first body stands.
class Mjcf {
 public:
  explicit Mjcf(const Mechanism& mechanism) : mechanism_(mechanism) {
    std::ostringstream xml;
    xml << "<mujoco><compiler angle=\"radian\"/><option timestep=\"" << step_length
        << "\" gravity=\"0 0 " << -standard_gravity
        << "\"><flag constraint=\"disable\" contact=\"disable\"/></option><worldbody>";
    write_children(xml, -1, 1);
    xml << "</worldbody></mujoco>";
    files.emplace_back("model.xml", xml.str());
  }
  std::vector<std::pair<std::string, std::string>> files;  // name and text; the model is the last

 private:
  void write_children(std::ostream& xml, int parent, int depth) {
    for (auto i = static_cast<std::size_t>(parent + 1); i < mechanism_.links.size(); ++i) {
      if (mechanism_.links[i].parent != parent) continue;
      if (depth % 80 != 0) {
        write_link(xml, i, depth);
        continue;
      }
      std::ostringstream part;
      part << "<mujocoinclude>";
      write_link(part, i, depth);
      part << "</mujocoinclude>";
      const std::string name = "from" + std::to_string(i) + ".xml";
      files.emplace_back(name, part.str());
      xml << "<include file=\"" << name << "\"/>";
    }
  }
  void write_link(std::ostream& xml, std::size_t i, int depth) {
    const Link& link = mechanism_.links[i];
    const Eigen::Quaterniond R(matrix3(link.rotation));
    const Numbers9& I = link.inertia;
    xml << "<body pos=\"" << mjcf(link.position) << "\" quat=\""
        << mjcf(std::array{R.w(), R.x(), R.y(), R.z()}) << "\">";
    if (i < mechanism_.first_joint()) {
      xml << "<freejoint/>";
    } else {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(link.axis));
      xml << "<joint type=\"hinge\" axis=\"" << mjcf(axis) << "\"/>";
    }
    xml << "<inertial pos=\"" << mjcf(link.com) << "\" mass=\"" << mjcf(std::array{link.mass})
        << "\" fullinertia=\"" << mjcf(std::array{I[0], I[4], I[8], I[1], I[2], I[5]}) << "\"/>";
    write_children(xml, static_cast<int>(i), depth + 1);
    xml << "</body>";
  }
  const Mechanism& mechanism_;
};

class MuJoCo : public Engine {
 public:
  std::string name() const override { return "mujoco"; }
  bool has(Algorithm) const override { return true; }
  // It keeps the principal axes of an inertia as a quaternion that it finds by iteration to 1e-8 or
  // so: where the inertias are not diagonal, it computes another mechanism by that much.
  double tolerance(const Mechanism& mechanism) const override {
    const bool diagonal = std::ranges::all_of(mechanism.links, [](const Link& link) {
      return link.inertia[1] == 0 && link.inertia[2] == 0 && link.inertia[5] == 0;
    });
    return diagonal ? 1e-9 : 1e-6;
  }

  void load(const Mechanism& mechanism) override {
    mechanism_ = mechanism;
    // it would write a log file
    mju_user_warning = [](const char* text) { std::cerr << "MuJoCo warns: " << text << '\n'; };
    const auto disk = std::make_unique<mjVFS>();  // files in memory
    mj_defaultVFS(disk.get());
    for (const auto& [name, xml] : Mjcf(mechanism).files) {
      mj_makeEmptyFileVFS(disk.get(), name.c_str(), static_cast<int>(xml.size()));
      std::copy(xml.begin(), xml.end(), static_cast<char*>(disk->filedata[disk->nfile - 1]));
    }
    char fault[500] = "";
    model_.reset(mj_loadXML("model.xml", disk.get(), fault, sizeof fault));
    mj_deleteVFS(disk.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    data_.reset(mj_makeData(model_.get()));
  }

  // Its coordinates are the canonical ones: linear velocity in world axes, angular in body axes.
  // The links come in the order of a depth-first walk, which is the order of all the models.
  void set_situations(const std::vector<Situation>& situations) override {
    situations_ = situations;
  }

  void run(Algorithm algorithm) override {
    for (std::size_t k = 0; k < situations_.size(); ++k) run(algorithm, k);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, k);
    return {data_->qacc_smooth, data_->qacc_smooth + model_->nv};
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, k);
    return joints_of(mechanism_, {data_->qfrc_inverse, data_->qfrc_inverse + model_->nv});
  }

 private:
  void run(Algorithm algorithm, std::size_t k) {
    const mjModel* m = model_.get();
    mjData* d = data_.get();
    const Situation& s = situations_[k];
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
      case Algorithm::mass_matrix:  // leaves it sparse, the way MuJoCo goes on with it
        position(m, d);
        mj_crb(m, d);
        break;
      case Algorithm::kinematics:
        mj_kinematics(m, d);
        break;
      case Algorithm::step:  // the whole of it: MuJoCo offers no smaller one
        std::copy(s.tau.begin(), s.tau.end(), d->qfrc_applied);
        mj_step(m, d);
        break;
    }
  }
  static void position(const mjModel* m, mjData* d) {
    mj_kinematics(m, d);
    mj_comPos(m, d);  // also what makes the com-based inertias and motion axes of crb and rne
  }

  Mechanism mechanism_;
  std::unique_ptr<mjModel, MujocoRelease> model_;
  std::unique_ptr<mjData, MujocoRelease> data_;
  std::vector<Situation> situations_;
};

}  // namespace

void add_mujoco(Engines& engines) {
  engines.push_back(std::make_unique<MuJoCo>());
}

}  // namespace twinarm::speed
