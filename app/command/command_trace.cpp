#include <fmt/format.h>

#include "app/command/commands.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/synthetic_operator.h"

namespace twinarm {

int run_trace(const TraceOptions& options) {
  const SyntheticOperator hand(options.seed, options.duration);
  write_trace(hand, options.rate, options.out);
  fmt::print("wrote {}: {}\n", options.out.string(), hand.description());
  return 0;
}

}  // namespace twinarm
