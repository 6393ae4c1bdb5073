// Times of several jobs, taken so that their ratios are fair on a machine with other work on it.
#pragma once

#include <functional>
#include <vector>

namespace twinarm::bench {

struct Timing {
  double ns = 0;      // thread CPU time of one call of the job, median of the repetitions
  double spread = 0;  // (longest - shortest) / median
};

// In every repetition all jobs run one after the other, each for about `seconds`: what disturbs the
// machine for a while disturbs all of them.
std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                     int repetitions, double seconds);

}  // namespace twinarm::bench
