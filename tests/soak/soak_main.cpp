// One scene of the soak run: soak SCENE SEED FIRST_EPISODE EPISODES SECONDS. scripts/check/soak
// calls it.
//
// Prints a JSON object a line for each episode.
// Ends at once on SIGINT and SIGTERM. Exit code 1: a fault was found.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/soak/soak_episode.h"

namespace {

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) {
  interrupted = 1;
}

void print(long episode, const twinarm::soak::EpisodeResult& r, double wall) {
  std::printf(
      "{\"episode\": %ld, \"seconds\": %.3f, \"steps\": %ld, \"unconverged\": %ld, \"above\": %ld, "
      "\"wedged\": %ld, "
      "\"residual\": %.3g, \"residual_at\": %.3f, \"depth\": %.3g, \"deep\": %ld, \"created\": "
      "%.3g, \"given\": %.3g, \"apart\": %.3g, \"excess\": %.3g, \"work\": %.6g, "
      "\"contacts\": %d, \"wall\": %.2f, \"fault\": \"%s\"}\n",
      episode, r.seconds, r.steps, r.unconverged, r.above, r.infeasible_impacts, r.residual,
      r.residual_at, r.depth, r.deep, r.created, r.given, r.apart, r.excess, r.work, r.contacts,
      wall, r.fault.c_str());
  std::fflush(stdout);
}

int run(char** argv) {
  using Clock = std::chrono::steady_clock;
  const std::string scene = argv[1];
  const std::uint64_t seed = std::strtoull(argv[2], nullptr, 10);
  const long first = std::atol(argv[3]), count = std::atol(argv[4]);
  const double seconds = std::atof(argv[5]);
  bool faulty = false;
  for (long episode = first; episode < first + count && !interrupted; ++episode) {
    const auto start = Clock::now();
    const auto result =
        twinarm::soak::run_episode(scene, seed, episode, seconds, [] { return interrupted == 0; });
    print(episode, result, std::chrono::duration<double>(Clock::now() - start).count());
    faulty = faulty || !result.fault.empty();
  }
  return interrupted ? 130 : faulty ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: %s SCENE SEED FIRST_EPISODE EPISODES SECONDS\n", argv[0]);
    return 2;
  }
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  try {
    return run(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  }
}
