// A scene's mechanism as a model of ours: its coordinates and velocities are those of the scene.
#pragma once

#include "benchmarks/scenes/scene.h"
#include "solver/model/model.h"

namespace twinarm::bench {

Model<double> model_of(const Scene& scene);

}  // namespace twinarm::bench
