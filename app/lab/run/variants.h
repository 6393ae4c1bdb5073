// Variants: runs of one scene side by side that differ in one parameter. The first is the run
// itself; each other one is a LabRun that follows the first one's clock with the same operator and
// mouse input. After a change of the scene they are made again from the last frame. Their frames
// are stored in LabFrame::variants. A stopped variant keeps its last frame. Not thread-safe.
#pragma once

#include "app/lab/run/lab_run.h"

namespace twinarm {

struct VariantSet {
  static constexpr std::size_t kMax = 7;  // distinguishable colours

  std::string path;                 // as of a Change: "integrator", "coupling.stiffness"
  std::vector<std::string> values;  // by variant
  std::optional<Vector3> apart;     // offset to the next one [m]; none: from the scene's width

  bool empty() const { return values.empty(); }
  Change change(std::size_t variant) const { return {path, values[variant]}; }
};

// "integrator=semi-implicit,rk4"; commas in brackets belong to a value. Throws InputError.
VariantSet parse_variants(const std::string& text);

// What is wrong with the set in any scene.
struct VariantProblem {
  std::string problem, fix;
};
std::optional<VariantProblem> problem_of(const VariantSet& variants);

// Appends a change (changes are applied in order), and removes an earlier one of the same path.
void put(std::vector<Change>& changes, const Change& change);

class LabVariants {
 public:
  LabVariants() = default;  // none
  // Plans from the second variant on; `from` null: the start. Throws InputError.
  LabVariants(const VariantSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
              const LabFrame* from, const LabNames& names);

  // After each step of the run: steps all to its time, with the input of that step.
  void follow(const LabRun& run);
  // Adds their frames to one of the run; new rows are added to `names`.
  void add_to(LabFrame& frame, LabNames& names);
  // A line for each variant that has stopped since the last call.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  struct Variant {
    std::string name;
    std::unique_ptr<OperatorInput> unused;  // its motion is that of the run
    std::unique_ptr<LabRun> run;            // null: stopped, and `last` is its last frame
    std::shared_ptr<const LabFrame> last;
    bool stopped = false;
  };
  void stop(Variant& variant);

  std::vector<Variant> variants_;
  std::vector<std::string> warnings_;
};

}  // namespace twinarm
