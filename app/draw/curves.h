// Curves that can be plotted below the pictures of a run, by name. A new one is a function and a
// line of the list in curves.cpp.
#pragma once

#include "app/draw/snapshot.h"
#include "app/render/text/plot.h"

namespace twinarm {

struct CurveSample {
  std::string name;
  double value = 0;
  bool from_lowest = false;  // relative to the minimum of the first curve
};

struct CurveKind {
  const char* name;   // of --plot
  const char* title;  // with the unit
  std::vector<CurveSample> (*sample)(const SceneModel* scene, const Snapshot& snapshot);
};

const std::vector<CurveKind>& all_curves();

// Names of a comma list out of `known`; "none" is skipped, "all" gives all. Throws InputError with
// all unknown names; `noun`: of one, for messages.
std::vector<std::string> parse_names(const std::string& text, const std::string& option,
                                     const std::string& noun,
                                     const std::vector<std::string>& known);

// "energy,forces"; "none". Throws InputError.
std::vector<const CurveKind*> parse_curves(const std::string& text);

// Collects one plot of a run for each kind.
class CurveTrace {
 public:
  explicit CurveTrace(const std::vector<const CurveKind*>& kinds);
  void add(const SceneModel* scene, const Snapshot& snapshot);
  std::vector<Plot> plots() const;  // one for each kind, each with a range of its own

 private:
  std::vector<const CurveKind*> kinds_;
  std::vector<Plot> plots_;
};

}  // namespace twinarm
