// A recorded instant, as what there is to be seen of it.
#pragma once

#include <vector>

#include "app/draw/snapshot.h"
#include "app/record/recording.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Of the step that ended here; at the start of the one that begins here.
struct RunInstant {
  State<double> x;
  std::vector<Vector3> pulls;
  std::vector<RecordedContact> contacts;
};

// Whether forces do: by the joints between the body and the world.
bool moves_by_forces(const Model<double>& model, std::size_t body);

RunInstant instant_of(const RecordedFrame& frame, const Model<double>& model);
// `couplings`: of the scene; null for a robot alone. Contacts of other scenes are left out.
Moment moment_of(const SimulateInput& input, SceneCouplings* couplings, const RunInstant& instant);

}  // namespace twinarm
