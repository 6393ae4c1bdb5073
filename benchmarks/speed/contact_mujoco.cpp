// MuJoCo's contact scenes: Newton's method and elliptic cones, all else as it comes.
#include <algorithm>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "benchmarks/speed/contact_engine.h"
#include "benchmarks/speed/mujoco_model.h"

namespace twinarm::speed {
namespace {

std::string size_of(double half) {
  return " size=\"" + mjcf(std::array{half, half, half}) + "\"";
}

// The axes of scara3 all point along z and its links are not turned.
std::string arm() {
  std::ostringstream xml;
  const Push push;
  const Mechanism scara = scara3();
  for (const Link& link : scara.links) {
    const Numbers9& I = link.inertia;
    xml << "<body pos=\"" << mjcf(link.position) << "\"><joint type=\"hinge\" axis=\"0 0 1\"/>"
        << "<inertial pos=\"" << mjcf(link.com) << "\" mass=\"" << link.mass << "\" fullinertia=\""
        << mjcf(std::array{I[0], I[4], I[8], I[1], I[2], I[5]}) << "\"/>";
  }
  xml << "<geom name=\"tip\" type=\"sphere\" size=\"" << push.radius << "\" pos=\""
      << mjcf(push.tip) << "\"/>";
  for (std::size_t i = 0; i < scara.links.size(); ++i) xml << "</body>";
  xml << "<geom type=\"box\" pos=\"" << mjcf(push.obstacle) << "\"" << size_of(box_edge / 2)
      << "/>";
  return xml.str();
}

std::string boxes(const ContactScene& scene) {
  std::ostringstream xml;
  xml << "<geom type=\"plane\" size=\"10 10 1\"/>";
  for (const Numbers3& centre : scene.boxes)
    xml << "<body pos=\"" << mjcf(centre) << "\"><freejoint/><geom type=\"box\" mass=\"" << box_mass
        << "\"" << size_of(box_edge / 2) << "/></body>";
  return xml.str();
}

std::string mjcf(const ContactScene& scene) {
  std::ostringstream xml;
  xml << "<mujoco><compiler angle=\"radian\"/><size njmax=\"2400\" nconmax=\"800\"/>"
      << "<option timestep=\"" << scene.h << "\" gravity=\"0 0 " << -standard_gravity
      << "\" solver=\"Newton\" cone=\"elliptic\"/><default><geom friction=\"" << contact_friction
      << "\"/></default><worldbody>" << (scene.has_arm() ? arm() : boxes(scene))
      << "</worldbody></mujoco>";
  return xml.str();
}

class MuJoCo final : public ContactEngine {
 public:
  std::string name() const override { return "mujoco"; }

  void load(const ContactScene& scene) override {
    scene_ = scene;
    // it would write a log file
    mju_user_warning = [](const char* what) { std::cerr << "MuJoCo warns: " << what << '\n'; };
    const std::string xml = mjcf(scene);
    const auto disk = std::make_unique<mjVFS>();  // files in memory
    mj_defaultVFS(disk.get());
    mj_makeEmptyFileVFS(disk.get(), "scene.xml", static_cast<int>(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(disk->filedata[0]));
    char fault[500] = "";
    model_.reset(mj_loadXML("scene.xml", disk.get(), fault, sizeof fault));
    mj_deleteVFS(disk.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    data_.reset(mj_makeData(model_.get()));
    mj_forward(model_.get(), data_.get());
  }

  void step() override {
    if (scene_.has_arm())
      for (std::size_t j = 0; j < 3; ++j)
        data_->qfrc_applied[j] = push_.torque(j, data_->qpos[j], data_->qvel[j]);
    mj_step(model_.get(), data_.get());
  }

  // After a step MuJoCo has its geometries where the step began.
  std::vector<Placed> bodies() const override {
    if (scene_.has_arm()) {
      mj_kinematics(model_.get(), data_.get());
      const mjtNum* p = data_->geom_xpos + 3 * mj_name2id(model_.get(), mjOBJ_GEOM, "tip");
      return {{{p[0], p[1], p[2]}, {1, 0, 0, 0}}};
    }
    std::vector<Placed> all;
    for (std::size_t i = 0; i < scene_.boxes.size(); ++i) {
      const mjtNum* q = data_->qpos + 7 * i;
      all.push_back({{q[0], q[1], q[2]}, {q[3], q[4], q[5], q[6]}});
    }
    return all;
  }

 private:
  ContactScene scene_;
  Push push_;
  std::unique_ptr<mjModel, MujocoRelease> model_;
  std::unique_ptr<mjData, MujocoRelease> data_;
};

}  // namespace

void add_mujoco(ContactEngines& engines) {
  engines.push_back(std::make_unique<MuJoCo>());
}

}  // namespace twinarm::speed
