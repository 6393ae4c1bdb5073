#include "app/film/shown_instant.h"

#include <utility>

#include "app/run/run.h"

namespace twinarm {
namespace {

ShownContact shown(const SceneModel& scene, const RecordedContact& c) {
  const auto body_of_geometry = [&](int g) {
    return static_cast<std::size_t>(scene.geometries[static_cast<std::size_t>(g)].body);
  };
  ShownContact on_b{c.a,
                    c.b,
                    body_of_geometry(c.a),
                    body_of_geometry(c.b),
                    c.point,
                    c.normal,
                    c.force,
                    c.couple,
                    scene.surface_of_pair(c.a, c.b).friction};
  if (!moves_by_forces(scene.model, on_b.body_b) && moves_by_forces(scene.model, on_b.body_a)) {
    std::swap(on_b.a, on_b.b);
    std::swap(on_b.body_a, on_b.body_b);
    on_b.n_W = -on_b.n_W;
    on_b.force_W = -on_b.force_W;
    on_b.couple_W = -on_b.couple_W;
  }
  return on_b;
}

}  // namespace

bool moves_by_forces(const Model<double>& model, std::size_t body) {
  for (std::size_t i = body; i > 0; i = static_cast<std::size_t>(model.parent[i])) {
    if (model.joint[i] == JointType::prescribed) return false;
    if (model.joint[i] != JointType::fixed) return true;
  }
  return false;
}

RunInstant instant_of(const RecordedFrame& frame, const Model<double>& model) {
  RunInstant instant;
  instant.x = State<double>(model);
  Memory memory = simulation_memory(frame.memory);
  visit_state(memory, model, instant.x);
  instant.pulls = frame.pulls;
  instant.contacts = frame.contacts;
  return instant;
}

Moment moment_of(const SimulateInput& input, SceneCouplings* couplings, const RunInstant& instant) {
  const SceneModel* scene = input.scene.get();
  if (!scene || !couplings) return moment_of(input.robot.model, instant.x);
  Moment moment = moment_of(*scene, *couplings, instant.x, instant.pulls);
  const auto count = static_cast<int>(scene->geometries.size());
  for (const RecordedContact& c : instant.contacts)
    if (c.a >= 0 && c.b >= 0 && c.a < count && c.b < count)
      moment.contacts.push_back(shown(*scene, c));
  return moment;
}

}  // namespace twinarm
