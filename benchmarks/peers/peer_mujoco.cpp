// MuJoCo: mj_step with every one of its integrators; contacts by Newton's method, elliptic cones,
// all else as it comes. It has no coefficient of restitution.
#include <algorithm>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "benchmarks/peers/peer.h"
#include "benchmarks/speed/mujoco_model.h"

namespace twinarm::peers {
namespace {

using speed::mjcf, speed::MujocoRelease;

void write_children(std::ostream& xml, const Scene& scene, int parent) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& b = scene.bodies[i];
    if (b.parent != parent) continue;
    xml << "<body pos=\"" << mjcf(b.position) << "\" quat=\"" << mjcf(b.turn) << "\">";
    if (b.joint == Joint::free)
      xml << "<freejoint/>";
    else if (b.joint == Joint::ball)
      xml << "<joint type=\"ball\"/>";
    else
      xml << "<joint type=\"hinge\" axis=\"0 0 1\"/>";
    xml << "<inertial pos=\"" << mjcf(b.com) << "\" mass=\"" << mjcf(std::array{b.mass})
        << "\" fullinertia=\"" << mjcf(b.inertia) << "\"/>";
    if (b.form != Form::none)
      xml << "<geom type=\"" << (b.form == Form::box ? "box" : "sphere") << "\" size=\""
          << mjcf(b.half) << "\" condim=\"" << (scene.friction > 0 ? 3 : 1) << "\" friction=\""
          << scene.friction << "\"/>";
    write_children(xml, scene, static_cast<int>(i));
    xml << "</body>";
  }
}

// A pair takes the larger friction, unless one surface has priority.
std::string mjcf(const Scene& scene, const std::string& integrator, double h) {
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><compiler angle=\"radian\"/><size njmax=\"3000\" nconmax=\"1000\"/>"
      << "<option timestep=\"" << h << "\" gravity=\"" << mjcf(scene.gravity) << "\" integrator=\""
      << integrator << "\" solver=\"Newton\" cone=\"elliptic\"/><worldbody>";
  if (scene.floor)
    xml << "<geom type=\"plane\" size=\"50 50 1\" priority=\"1\" condim=\""
        << (scene.floor_friction > 0 ? 3 : 1) << "\" friction=\"" << scene.floor_friction << "\"/>";
  write_children(xml, scene, -1);
  xml << "</worldbody></mujoco>";
  return xml.str();
}

class MuJoCo final : public FixedStepPeer {
 public:
  std::string name() const override { return "mujoco"; }
  std::vector<Scheme> schemes(const Scene& scene) const override {
    if (!refusal(scene).empty()) return {};
    return {{"Euler"}, {"RK4"}, {"implicit"}};
  }
  std::string refusal(const Scene& scene) const override {
    return scene.restitution > 0 ? "MuJoCo has no coefficient of restitution" : "";
  }

  // Its coordinates are ours; of a free body the linear velocity comes first.
  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(h);
    scene_ = scene;
    mju_user_warning = [](const char* what) { std::cerr << "MuJoCo warns: " << what << '\n'; };
    const std::string xml = mjcf(scene, scheme.name, h);
    const auto disk = std::make_unique<mjVFS>();  // files in memory
    mj_defaultVFS(disk.get());
    mj_makeEmptyFileVFS(disk.get(), "scene.xml", static_cast<int>(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(disk->filedata[0]));
    char fault[500] = "";
    model_.reset(mj_loadXML("scene.xml", disk.get(), fault, sizeof fault));
    mj_deleteVFS(disk.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    data_.reset(mj_makeData(model_.get()));
    std::copy(scene.q.begin(), scene.q.end(), data_->qpos);
    std::copy(scene.v.begin(), scene.v.end(), data_->qvel);
    swap_free(data_->qvel);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      std::copy_n(scene.bodies[i].push.data(), 3, data_->xfrc_applied + 6 * (i + 1));
  }
  void step() override { mj_step(model_.get(), data_.get()); }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q.assign(data_->qpos, data_->qpos + model_->nq);
    v.assign(data_->qvel, data_->qvel + model_->nv);
    swap_free(v.data());
  }

 private:
  void swap_free(double* v) const {
    for (const Body& b : scene_.bodies) {
      if (b.joint == Joint::free) std::swap_ranges(v, v + 3, v + 3);
      v += velocities_of(b.joint);
    }
  }
  Scene scene_;
  std::unique_ptr<mjModel, MujocoRelease> model_;
  std::unique_ptr<mjData, MujocoRelease> data_;
};

}  // namespace

void add_mujoco(Peers& peers) {
  peers.push_back(std::make_unique<MuJoCo>());
}

}  // namespace twinarm::peers
