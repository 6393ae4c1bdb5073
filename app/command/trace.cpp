#include <fmt/format.h>

#include "app/command/command.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/synthetic_operator.h"

namespace twinarm {
namespace {

struct TraceOptions {
  unsigned seed = 1;
  double duration = 20, rate = 200;  // [s], [Hz]
  std::filesystem::path out;
};

void add_options(const OptionAdder& add, TraceOptions& options) {
  add.group("Motion");
  add("--seed", options.seed, "random seed of the motion");
  add("--duration", options.duration, "[s]")->check(above_zero(1000));
  add("--rate", options.rate, "sampling rate [Hz]")->check(above_zero(1000));
  add.output("--out", options.out, ".csv", "CSV file to write")->required();
}

int run_trace(const TraceOptions& options) {
  const SyntheticOperator hand(options.seed, options.duration);
  write_trace(hand, options.rate, options.out);
  fmt::print("wrote {}: {}\n", options.out.string(), hand.description());
  return 0;
}

}  // namespace

Command trace_command() {
  return {160, "trace",
          "Generate a synthetic operator motion (CSV)\n\n"
          "Examples:\n"
          "  twinarm trace --out hand.csv\n"
          "  twinarm trace --seed 7 --duration 60 --rate 200 --out hand.csv",
          add_options, run_trace};
}

}  // namespace twinarm
