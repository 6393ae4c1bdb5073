// Output of `twinarm simulate`: one JSON object, CSV row by row, or tables.
#pragma once

#include <memory>

#include "app/inspect/series/force_series.h"
#include "app/run/run.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class RunOutput {
 public:
  virtual ~RunOutput() = default;
  virtual void sample(double t, const State<double>& x) = 0;
  virtual void end(const SimulateResult& result) = 0;
};

// They print to stdout: JSON and tables at the end, CSV during the run. They keep references to
// their arguments. `forces` may be null.
std::unique_ptr<RunOutput> json_output(const SimulateInput& input, const RunPlan& plan,
                                       ForceSeries* forces);
std::unique_ptr<RunOutput> csv_output(const SimulateInput& input, ForceSeries* forces);
std::unique_ptr<RunOutput> table_output(const SimulateInput& input, const RunPlan& plan);

}  // namespace twinarm
