#include "app/lab/run/remedy_trial.h"

#include <exception>

#include "app/lab/run/variants.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxFixes = 3;

struct Candidate {
  SuggestedFix fix;
  bool is_suggested = true;  // else made from one that did not hold
};

// Inputs of the stopped run by time; null after its end, but for a physical device, whose target
// then rests where they left it.
class RepeatedInputs {
 public:
  explicit RepeatedInputs(const RemedyTrial& trial)
      : inputs_(trial.inputs), is_physical_(trial.source == OperatorInput::Source::device) {
    if (inputs_.empty() || !inputs_.back().hand) return;
    rest_.hand = inputs_.back().hand;
    for (std::size_t j = 0; j < rest_.hand->sample.theta.size(); ++j) {
      double& rate = rest_.hand->sample.theta_dot[j];
      rest_.hand->sample.theta[j] += rest_.hand->h * std::exchange(rate, 0);
    }
  }
  // Times ascend from call to call.
  const LabInput* at(double t) {
    const double after = t + 1e-9 * std::max(1.0, t);
    while (next_ < inputs_.size() && inputs_[next_].t + inputs_[next_].h <= after) ++next_;
    if (next_ == inputs_.size()) return is_physical_ ? &rest_ : nullptr;
    return inputs_[next_].t <= after ? &inputs_[next_] : &none_;
  }

 private:
  const std::vector<LabInput>& inputs_;
  bool is_physical_;
  std::size_t next_ = 0;
  LabInput none_, rest_;
};

struct Trials {
  const RemedyTrial& trial;
  const std::function<bool()>& is_cancelled;
  const double begun = thread_cpu_time();
  std::deque<Candidate> waiting{};

  std::vector<SuggestedFix> run(const std::vector<SuggestedFix>& suggested) {
    for (const SuggestedFix& fix : suggested) waiting.push_back({fix, true});
    std::vector<SuggestedFix> found;
    for (std::size_t n = 0; n < RemedyTrial::kMaxTried && !waiting.empty(); ++n) {
      const Candidate candidate = std::move(waiting.front());
      waiting.pop_front();
      try {
        if (holds(candidate)) found.push_back(candidate.fix);
      } catch (const std::exception&) {  // this change is not possible in this scene
      }
      if (is_cancelled() || found.size() == kMaxFixes ||
          thread_cpu_time() - begun > trial.max_cpu_of_all)
        break;
    }
    return found;
  }

  bool holds(const Candidate& candidate) {
    std::vector<Change> changes = trial.changes;
    for (const std::string& text : candidate.fix.changes) put(changes, parse_change(text));
    OperatorInput hand;
    if (trial.source != OperatorInput::Source::device) hand.choose(trial.source);
    LabRun run(trial.scene->plan(changes), hand, trial.from.get());
    run.carry_over_energy(*trial.from, trial.names);
    RepeatedInputs inputs(trial);
    const double end = trial.stopped_at + RemedyTrial::kHold;
    const double start = thread_cpu_time();
    while (run.view().time() < end) {
      if (is_cancelled() || thread_cpu_time() - start > trial.max_cpu) return false;
      if (run.step(inputs.at(run.view().time()))) continue;
      const PostMortem* found = run.post_mortem();
      if (found && candidate.is_suggested)
        for (const SuggestedFix& next : fixes_of(run.prepared(), *found))
          waiting.push_back({combined(candidate.fix, next), false});
      return false;
    }
    return true;
  }

  // Later changes of the same path replace earlier ones.
  static SuggestedFix combined(const SuggestedFix& first, const SuggestedFix& second) {
    std::vector<Change> changes;
    for (const SuggestedFix* fix : {&first, &second})
      for (const std::string& text : fix->changes) put(changes, parse_change(text));
    SuggestedFix both{second.words, {}};
    if (changes.size() > second.changes.size()) both.words = first.words + "; " + second.words;
    for (const Change& change : changes) both.changes.push_back(change.path + "=" + change.value);
    return both;
  }
};

}  // namespace

std::vector<SuggestedFix> fixes_that_hold(const RemedyTrial& trial,
                                          const std::vector<SuggestedFix>& suggested,
                                          const std::function<bool()>& is_cancelled) {
  return Trials{trial, is_cancelled}.run(suggested);
}

}  // namespace twinarm
