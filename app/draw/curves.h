// Curves: what can be plotted under the pictures of a run, by name. A new one is a function in
// curves.cpp and its line in the list there.
#pragma once

#include <string>
#include <vector>

#include "app/draw/snapshot.h"
#include "app/render/text/plot.h"

namespace twinarm {

struct CurveSample {
  std::string name;
  double value = 0;
  bool from_lowest = false;  // has no zero of its own: counted from the lowest of the first sample
};

struct CurveKind {
  const char* name;   // of --plot
  const char* title;  // with the unit
  std::vector<CurveSample> (*sample)(const SceneModel* scene, const Snapshot& moment);
};

const std::vector<CurveKind>& all_curves();

// "energy,pulls"; "none". Throws InputError with all faults.
std::vector<const CurveKind*> parse_curves(const std::string& text);

// Gathers the plots of a run, one for each kind, moment by moment.
class CurveTrace {
 public:
  explicit CurveTrace(const std::vector<const CurveKind*>& kinds);
  void add(const SceneModel* scene, const Snapshot& moment);
  std::vector<Plot> plots() const;  // one for each kind, each with a range of its own

 private:
  std::vector<const CurveKind*> kinds_;
  std::vector<Plot> plots_;
};

}  // namespace twinarm
