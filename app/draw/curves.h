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
};

struct CurveKind {
  const char* name;   // of --plot
  const char* title;  // with the unit
  std::vector<CurveSample> (*sample)(const SceneModel* scene, const Moment& moment);
  bool from_lowest = false;  // a potential: its zero is the lowest of the run
};

const std::vector<CurveKind>& all_curves();

// "energy,pulls"; "none". Throws InputError with all faults.
std::vector<const CurveKind*> parse_curves(const std::string& text);

// Gathers the plots of a run, one for each kind, moment by moment.
class CurveTrace {
 public:
  explicit CurveTrace(const std::vector<const CurveKind*>& kinds);
  void add(const SceneModel* scene, const Moment& moment);
  std::vector<Plot> plots() const;  // one for each kind, each with a range of its own

 private:
  std::vector<const CurveKind*> kinds_;
  std::vector<Plot> plots_;
};

}  // namespace twinarm
