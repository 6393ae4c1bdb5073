#include "coupling/analysis/tracking_run.h"

#include <algorithm>
#include <cmath>

#include "solver/support/diagnostics.h"

namespace twinarm {

TrackingError tracking_error(const TrackingSeries& series) {
  TrackingError error;
  const std::size_t n = series.t.size();
  for (std::size_t j = 0; j < series.q_K.size(); ++j) {
    double largest = 0, integral = 0, before = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const double e = std::abs(series.q_K[j][s] - series.q_D[j][s]);
      largest = std::max(largest, e);
      if (s > 0) integral += 0.5 * (e + before) * (series.t[s] - series.t[s - 1]);
      before = e;
    }
    error.max.push_back(largest);
    error.mean.push_back(n > 1 ? integral / (series.t.back() - series.t.front()) : 0.0);
  }
  return error;
}

TrackingSystem::TrackingSystem(const TrackingSetup& setup) : setup_(setup) {
  check_step_size(setup.h);
  kvr_ = std::make_unique<KinematicRobot>(*setup.kvr_model, *setup.hand, setup.mapping,
                                          setup.joints, setup.kvr_rates);
  State<double> start(*setup.dvr_model);
  start.q = kvr_->start().x.q;  // the DVR starts at rest on the KVR's pose
  simulation_ = std::make_unique<Simulation>(*setup.dvr_model, start);
  for (const CouplingSpec& spec : setup.couplings) {
    couplings_.push_back(make_coupling(spec, *setup.dvr_model, *kvr_));
    simulation_->add(*couplings_.back());
  }
  simulation_->set_integrator(setup.integrator);
  for (const std::string& name : setup.joints.turned)
    iq_.push_back(setup.dvr_model->iq[static_cast<std::size_t>(setup.dvr_model->find_joint(name))]);
}

void TrackingSystem::record(TrackingSeries& series) {
  const State<double>& x = simulation_->state();
  series.t.push_back(x.t);
  for (std::size_t j = 0; j < iq_.size(); ++j) {
    series.q_K[j].push_back(kvr_->at(x.t).x.q[iq_[j]]);
    series.q_D[j].push_back(x.q[iq_[j]]);
  }
  for (std::size_t s = 0; s < series.pull.size(); ++s)
    series.pull[s].push_back(couplings_.front()->readings()[s].size);
}

TrackingSeries TrackingSystem::run(const std::function<void(double)>& each_step) {
  constexpr double kOutOfAllBounds = 1e3;  // rad: the run has diverged
  TrackingSeries series;
  series.q_K.resize(iq_.size());
  series.q_D.resize(iq_.size());
  series.pull.resize(couplings_.empty() ? 0 : couplings_.front()->springs().size());
  const auto steps = static_cast<std::size_t>(std::lround(setup_.hand->duration() / setup_.h));
  const auto sample = [&] {
    record(series);
    if (each_step) each_step(simulation_->state().t);
  };
  sample();
  for (std::size_t n = 0; n < steps; ++n) {
    const StepReport report = simulation_->step(setup_.h);
    const auto& q = simulation_->state().q;
    const bool bounded = std::all_of(
        iq_.begin(), iq_.end(), [&](std::size_t iq) { return std::abs(q[iq]) < kOutOfAllBounds; });
    if (!report.finite || !bounded) {
      series.finite = false;
      break;
    }
    sample();
  }
  return series;
}

}  // namespace twinarm
