#include "coupling/laws/coupling_spec.h"

#include <algorithm>

#include "coupling/laws/bushing.h"
#include "coupling/laws/equivalent_torsional.h"
#include "coupling/laws/god_object.h"
#include "coupling/laws/linear.h"
#include "coupling/laws/stable_pd.h"
#include "coupling/laws/torsional.h"

namespace twinarm {

std::unique_ptr<Coupling> make_coupling(const CouplingSpec& spec, const Model<double>& model,
                                        KinematicRobot& kvr) {
  switch (spec.type) {
    case CouplingSpec::Type::matched:
      return std::make_unique<MatchedTorsional>(spec.name, model, kvr, spec.springs);
    case CouplingSpec::Type::bushing:
      return std::make_unique<Bushing>(spec.name, model, kvr, spec.springs, spec.treatment,
                                       spec.hold_steps);
    case CouplingSpec::Type::weld_like:
      return std::make_unique<WeldLike>(spec.name, model, kvr, spec.springs, spec.reference,
                                        spec.treatment);
    case CouplingSpec::Type::stable_pd:
      return std::make_unique<StablePd>(spec.name, model, kvr, spec.springs);
    case CouplingSpec::Type::god_object:
      return std::make_unique<GodObject>(spec.name, model, kvr, spec.springs);
    case CouplingSpec::Type::torsional:
      if (spec.printed)
        return std::make_unique<PrintedTorsional>(spec.name, model, kvr, spec.springs,
                                                  spec.options);
      return std::make_unique<TorsionalCoupling>(spec.name, model, kvr, spec.springs, spec.measure,
                                                 spec.treatment, spec.hold_steps);
    case CouplingSpec::Type::linear:
      break;
  }
  if (spec.printed)
    return std::make_unique<PrintedLinear>(spec.name, model, kvr, spec.springs, spec.options);
  return std::make_unique<LinearCoupling>(spec.name, model, kvr, spec.springs, spec.treatment,
                                          spec.hold_steps);
}

const CouplingFacts& facts_of(CouplingSpec::Type type, bool printed) {
  return *std::find_if(all_couplings.begin(), all_couplings.end(), [&](const CouplingFacts& facts) {
    return facts.type == type && facts.printed == printed;
  });
}

}  // namespace twinarm
