#include "app/scene/forces/add_contacts.h"

#include <fmt/format.h>

#include "app/scene/read/read_scene.h"
#include "app/support/parallel_for.h"
#include "app/support/progress.h"

namespace twinarm {

namespace {

// Shapes of all geometries. Files of meshes are read one after the other, since a process with
// threads should not fork; hulls are made on all processors.
std::vector<Shape> collision_shapes(const SceneModel& scene) {
  std::vector<Shape> shapes;
  std::vector<std::size_t> convex;           // indices of meshes to be replaced by their hulls
  std::vector<std::vector<Vector3>> points;  // of these
  std::size_t triangles = 0;                 // of the other meshes
  for (const SceneGeometry& geometry : scene.geometries) {
    const auto* file = std::get_if<MeshGeometry>(&geometry.shape);
    if (file && file->convex) {
      convex.push_back(shapes.size());
      points.push_back(load_mesh(*file).vertices);
      shapes.emplace_back();
      continue;
    }
    shapes.push_back(collision_shape(geometry.shape));
    if (file) triangles += std::get<MeshShape>(shapes.back()).mesh.triangles.size();
    constexpr std::size_t kMaxTriangles = 300000;  // each takes 2.5 kB
    if (triangles > kMaxTriangles)
      throw InputError({{scene.description.file.string(), 0, "",
                         "meshes that may touch have more than 300,000 triangles in all",
                         "give convex = true, or simplify them", "scene.too-many"}});
  }
  Progress progress(false, Progress::kPatience);
  progress.stage("convex hulls", 1);
  auto hulls = parallel_results(
      convex.size(), [&](std::size_t k) { return convex_hull(points[k]); },
      [&](std::size_t done) { progress.advance(done, convex.size()); });
  for (std::size_t k = 0; k < convex.size(); ++k) shapes[convex[k]] = hulls[k].get();
  return shapes;
}

}  // namespace

bool limits_act(const SceneModel& scene, Integrator integrator) {
  const auto has_limits = [](const RobotInScene& robot) {
    return std::ranges::any_of(robot.description.joints, &JointDescription::is_limited);
  };
  return integrator == Integrator::semi_implicit &&
         std::ranges::any_of(scene.description.robots, has_limits);
}

bool steps_for_flight(const SceneModel& scene, Integrator integrator) {
  if (integrator != Integrator::semi_implicit) return false;
  const Model<double>& model = scene.model;
  for (int body = 1; body < model.body_count(); ++body) {
    const auto i = static_cast<std::size_t>(body);
    if (model.joint[i] == JointType::free && model.parent[i] == 0 && model.last_child[i] == 0 &&
        std::ranges::none_of(scene.constraints,
                             [&](const SceneConstraint& c) { return c.a == body || c.b == body; }))
      return true;
  }
  return false;
}

bool locates_events(const SceneModel& scene) {
  return scene.description.contact == ContactMode::event;
}

void check_contacts(const SceneModel& scene, Integrator integrator, DiagnosticList& faults) {
  const std::string file = scene.description.file.string();
  if (locates_events(scene))
    for (const SceneCoupling& coupling : scene.couplings)
      if (coupling.is_first_component() && coupling.needs_semi_implicit())
        faults.add({file, coupling.line, "coupling '" + coupling.coupling + "'",
                    "an implicit coupling cannot be combined with contact = \"event\"",
                    "give discretization = \"explicit\", or contact = \"rigid\"",
                    "scene.discretization"});
  if (locates_events(scene) && scene.description.sleep > 0)
    faults.add({file, 0, "sleep", "cannot be combined with contact = \"event\"",
                "remove the key, or give contact = \"rigid\"", "scene.sleep"});
  if (integrator == Integrator::semi_implicit) return;
  const auto fault = [&](const std::string& what, const char* fix) {
    faults.add({file, 0, "integrator",
                what + " the integrator semi-implicit, not " + integrator_name(integrator),
                std::string("give --integrator semi-implicit, or ") + fix, "run.integrator"});
  };
  if (scene.may_touch())
    fault("contacts need", "exclude contacts by groups");
  else if (locates_events(scene))
    fault("contact = \"event\" needs", "--contact rigid");
}

SceneContacts::SceneContacts(const SceneModel& scene, Simulation& simulation) : scene_(scene) {
  std::vector<LoopClosure> loops;
  for (const SceneConstraint& c : scene.constraints)
    loops.push_back(
        {c.name, c.type, c.a, c.b, c.X_AC, c.X_BC, c.length, c.ratio, c.offset, c.motion});
  if (!loops.empty()) simulation.set_loops(std::move(loops));
  const bool may_touch = scene.may_touch();
  simulation.set_impulse_effort(scene.description.accuracy.value_or(ImpulseAccuracy{}.accepted),
                                scene.description.budget);
  simulation.set_sleep(scene.description.sleep);
  if (may_touch) {
    contacts_.emplace(scene.model, scene.description.contact == ContactMode::compliant
                                       ? ContactResponse::compliant
                                       : ContactResponse::rigid);
    add_geometries();
    find_deepest_contact(simulation);
    simulation.add(*contacts_);
  }
  const bool flies =
      !may_touch && !locates_events(scene) && steps_for_flight(scene, simulation.integrator());
  if (flies || limits_act(scene, simulation.integrator())) {
    limits_.emplace(scene.model);  // for flight maybe without a limit
    add_limits();
    simulation.add(*limits_);
  }
  if (!locates_events(scene)) return;
  if (deepest_at_start_ > ContactConstraints::kSlop)
    throw InputError({{scene.description.file.string(), 0, "contact",
                       "initial penetration of " + deepest_pair_ + ": " +
                           short_number_text(deepest_at_start_) + " m",
                       "move them apart, or give contact = \"rigid\"", "scene.deep"}});
  simulation.locate_events();
}

void SceneContacts::add_geometries() {
  if (scene_.description.detection == Detection::fcl) contacts_->bodies().world().use_fcl();
  std::vector<Shape> shapes = collision_shapes(scene_);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const SceneGeometry& g = scene_.geometries[k];
    contacts_->bodies().add({g.name, g.body, g.X_LG, std::move(shapes[k]), g, 0});
  }
  contacts_->bodies().world().set_pair_filter(
      [&scene = scene_](int a, int b) { return scene.is_apart(a, b); });
  for (const auto& [ids, unused] : scene_.pairs)
    contacts_->bodies().set_pair(ids.first, ids.second,
                                 scene_.surface_of_pair(ids.first, ids.second));
}

void SceneContacts::add_limits() {
  for (std::size_t r = 0; r < scene_.description.robots.size(); ++r)
    for (const JointDescription& joint : scene_.description.robots[r].description.joints) {
      const int body = scene_.model.find_joint(name_in_scene(scene_.description, r, joint.name));
      if (joint.is_limited() && body > 0) limits_->add(body, joint.lower, joint.upper);
    }
}

void SceneContacts::find_deepest_contact(const Simulation& simulation) {
  contacts_->begin_step(simulation.kinematics(), simulation.state(), 0);
  for (const ContactPoint& point : contacts_->points()) {
    const Contact& contact = point.contact;
    if (contact.depth <= deepest_at_start_) continue;
    deepest_at_start_ = contact.depth;
    deepest_pair_ = "'" + contacts_->bodies().geometry(contact.a).name + "' and '" +
                    contacts_->bodies().geometry(contact.b).name + "'";
  }
}

std::vector<ContactWork> SceneContacts::work_by_names() const {
  const auto first_of_name = [&](int i) {
    const auto name = [&](int k) -> const std::string& {
      return contacts_->bodies().geometry(k).name;
    };
    while (i > 0 && name(i - 1) == name(i)) --i;
    return i;
  };
  std::map<std::pair<int, int>, ContactWork> sums;
  for (const ContactWork& pair : contacts_->work()) {
    const std::pair names(first_of_name(pair.a), first_of_name(pair.b));
    ContactWork& sum =
        sums.try_emplace(names, ContactWork{names.first, names.second}).first->second;
    sum.normal += pair.normal, sum.friction += pair.friction, sum.impact += pair.impact;
    sum.impulse_W += pair.impulse_W, sum.moment_W += pair.moment_W;
  }
  std::vector<ContactWork> works;
  for (const auto& [names, sum] : sums) works.push_back(sum);
  return works;
}

std::vector<EnergyRow> SceneContacts::rows() const {
  std::vector<EnergyRow> rows;
  const auto add = [&](EnergyRowKind kind, const std::string& of, std::string_view part,
                       double work) {
    if (work == 0) return;
    std::string& name = rows.emplace_back(EnergyRow{kind, {}, work}).name;
    name.reserve(of.size() + part.size());
    name.append(of).append(part);
  };
  if (limits_)
    for (const JointLimits::Limit& limit : limits_->limits()) {
      const auto body = static_cast<std::size_t>(limit.body);
      add(EnergyRowKind::joint_limit, "joint/" + scene_.model.joint_name[body], "/limit",
          limit.work);
    }
  if (!contacts_) return rows;
  const std::vector<ContactWork> works = work_by_names();
  rows.reserve(rows.size() + 3 * works.size());
  for (const ContactWork& pair : works) {
    const std::string name = "contact/" + contacts_->bodies().geometry(pair.a).name + "-" +
                             contacts_->bodies().geometry(pair.b).name;
    add(EnergyRowKind::contact_normal, name, "/normal", pair.normal);
    add(EnergyRowKind::contact_friction, name, "/friction", pair.friction);
    add(EnergyRowKind::contact_impact, name, "/impact", pair.impact);
  }
  return rows;
}

int SceneContacts::contact_count() const {
  if (!contacts_) return 0;
  return static_cast<int>(std::ranges::count_if(
      contacts_->points(), [](const ContactPoint& point) { return !point.force_W.isZero(0); }));
}

double SceneContacts::penetration() const {
  double deepest = 0;
  if (contacts_)
    for (const ContactPoint& point : contacts_->points())
      deepest = std::max(deepest, point.contact.depth);
  return deepest;
}

void LimitWatch::look(double t, const State<double>& x) {
  for (Limit& limit : limits_) {
    const double q = x.q[limit.iq];
    const double slack = 1e-9;  // for a joint at rest at its limit
    if (limit.is_reported || (q >= limit.joint->lower - slack && q <= limit.joint->upper + slack))
      continue;
    limit.is_reported = true;
    warnings_.push_back(fmt::format(
        "joint '{}' is at {}, beyond its limits {} .. {}, at t = {} s: position limits do not act "
        "here",
        limit.joint->name, short_number_text(q), short_number_text(limit.joint->lower),
        short_number_text(limit.joint->upper), short_number_text(t)));
  }
}

}  // namespace twinarm
