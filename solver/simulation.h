// One step, in the order that the data flows:
//
//   kinematics -> sources (targets, contacts, forces) -> ABA (+ implicit terms) -> integrate ->
//   report
//
// step() never throws and never allocates. The same inputs give the same bits.
#pragma once

#include <vector>

#include "solver/force_source.h"
#include "solver/integrator.h"
#include "solver/kinematics.h"
#include "solver/model.h"
#include "solver/workspace.h"

namespace twinarm {

struct StepReport {
  bool finite = true;
  int rounds = 1;  // of forces and ABA; more than one where a source asked for it
  // Where the first non-finite number stands, in the order in which the passes write; body 0 and
  // null where all is finite.
  int bad_body = 0;
  const char* bad_field = nullptr;
};

class Simulation {
 public:
  // The model must outlive the simulation; so must the sources.
  Simulation(const Model<double>& model, State<double> start);
  // Throws std::invalid_argument for a source that cannot go with the integrator.
  void add(ForceSource& source);
  void set_integrator(Integrator integrator);

  StepReport step(double h) noexcept;

  const Model<double>& model() const { return model_; }
  const State<double>& state() const { return x_; }
  const Kinematics& kinematics() const { return k_; }        // of state()
  const Workspace<double>& workspace() const { return w_; }  // of the last step's last ABA

 private:
  void accelerations(const State<double>& x, const Kinematics& k);
  int step_euler(double h);  // both Euler methods
  void step_rk4(double h);
  StepReport report(int rounds) const;

  const Model<double>& model_;
  State<double> x_, stage_;
  Kinematics k_, k_stage_;
  Workspace<double> w_;
  Forces<double> forces_;
  std::vector<ForceSource*> sources_;
  Integrator integrator_ = Integrator::semi_implicit;
  std::vector<double> theta_, rate_, theta_sum_, qdd_sum_;  // Runge-Kutta, by velocity
};

}  // namespace twinarm
