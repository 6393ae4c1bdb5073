// Cost of the disabled trace hook: aba() and a step with NoTrace against the same code without the
// hook, alternately. Prints a table of ratios; 1 means no cost.
//
// On a shared machine two runs of the same instructions differ by more than the cost of the hook.
// So each ratio is printed with that of the bare code to itself, which is the resolution.
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/no_trace_passes.h"
#include "benchmarks/drivers/timing.h"
#include "benchmarks/scenes/mechanisms.h"

namespace twinarm::bench {
namespace {

struct Work {
  Model<double> model;
  Workspace<double> w;
  std::vector<State<double>> states;
  std::vector<Forces<double>> forces;
  State<double> next;
  std::vector<double> shift;

  explicit Work(const Scene& mechanism)
      : model(model_of(mechanism)), w(model), next(model), shift(model.nv) {
    constexpr std::size_t kStates = 16;
    for (const Situation& s : situations(mechanism, kStates)) {
      states.emplace_back(model);
      states.back().q = s.q, states.back().qd = s.v;
      forces.emplace_back(model);
      forces.back().tau = s.tau;
    }
  }
  void passes(const NoTracePasses& text) {
    for (std::size_t k = 0; k < states.size(); ++k) text.pass(model, states[k], forces[k], w);
  }
  void steps(const NoTracePasses& text) {
    for (std::size_t k = 0; k < states.size(); ++k)
      text.step(model, states[k], forces[k], w, 1e-3, next, shift);
  }
};

// Median, minimum and maximum.
std::string text_of(std::vector<double> ratios) {
  std::ranges::sort(ratios);
  char text[80];
  std::snprintf(text, sizeof text, "%.4f  (%.4f to %.4f)", ratios[ratios.size() / 2],
                ratios.front(), ratios.back());
  return text;
}

// Ratios of hooked to bare, and of bare to itself; all alternate in each round.
void measure(const char* what, const char* model, Work& work,
             void (Work::*job)(const NoTracePasses&), int rounds, double seconds) {
  const NoTracePasses hooked = hooked_passes(), bare = bare_passes();
  const auto run = [&](const NoTracePasses& text) { return [&] { (work.*job)(text); }; };
  std::vector<double> hook, same;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Timing> t =
        round % 2 == 0 ? time_interleaved({run(hooked), run(bare), run(bare)}, 5, seconds)
                       : time_interleaved({run(bare), run(bare), run(hooked)}, 5, seconds);
    const std::size_t h = round % 2 == 0 ? 0 : 2, b = 1, c = round % 2 == 0 ? 2 : 0;
    hook.push_back(t[h].ns / t[b].ns);
    same.push_back(t[c].ns / t[b].ns);
  }
  std::printf("%-6s %-9s  %s     %s\n", what, model, text_of(hook).c_str(), text_of(same).c_str());
}

void run_all(int rounds, double seconds) {
  std::printf(
      "thread CPU time relative to the bare code; median of %d rounds (min to max)\n"
      "                 no trace                      the bare code again\n",
      rounds);
  for (const char* name : {"scara3", "puma6", "chain32"}) {
    Work work(mechanism(name));
    measure("aba", name, work, &Work::passes, rounds, seconds);
    measure("step", name, work, &Work::steps, rounds, seconds);
  }
}

// Calls of one of them, for tools that count instructions.
void only(std::string_view which, int calls) {
  Work work(mechanism("puma6"));
  const NoTracePasses text = which == "bare" ? bare_passes() : hooked_passes();
  for (int k = 0; k < calls; ++k) work.steps(text);
}

}  // namespace
}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  bool quick = false;
  std::string text;
  return run_program("bench_no_trace", "bench_no_trace [--quick | --only-bare | --only-hooked]\n",
                     argc, argv,
                     {{"--quick", &quick},
                      {"--only-bare", [&] { text = "bare"; }},
                      {"--only-hooked", [&] { text = "hooked"; }}},
                     [&] {
                       if (!text.empty())
                         only(text, 2000);
                       else
                         run_all(quick ? 1 : 21, quick ? 0.001 : 0.01);
                       return 0;
                     });
}
