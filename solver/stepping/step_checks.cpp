#include "solver/stepping/step_checks.h"

#include <stdexcept>
#include <string>

#include "solver/impulses/event_source.h"

namespace twinarm {
namespace {

void check_integrator(const StepParts& parts) {
  const std::string name = integrator_name(parts.integrator);
  if (parts.constrained && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument("contacts and limits go with the integrator 'semi-implicit' only");
  if (parts.located && parts.integrator != Integrator::semi_implicit)
    throw std::invalid_argument(
        "steps that locate their events go with the integrator 'semi-implicit' only, not with '" +
        name + "'");
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit() && !facts_of(parts.integrator).implicit_force)
      throw std::invalid_argument(
          "implicit spring-dampers and contacts go with the semi-implicit integrators only, not "
          "with " +
          name);
}

void check_located(const StepParts& parts) {
  for (const ForceSource* source : parts.forces)
    if (source->needs_semi_implicit())
      throw std::invalid_argument(
          "implicit spring-dampers do not go with steps that locate their events");
  for (const ConstraintSource* source : parts.constraints)
    if (!dynamic_cast<const EventSource*>(source))
      throw std::invalid_argument("a source of constraints cannot have its events located");
}

}  // namespace

void check_parts(const StepParts& parts) {
  check_integrator(parts);
  if (parts.located) check_located(parts);
  // Its force would be that of the first round: a wrong one, and nobody would say so.
  for (const ForceSource* source : parts.forces)
    if (parts.constrained && source->needs_rounds())
      throw std::invalid_argument(
          "a force that is found in rounds (ForceSource::refine) does not go with contacts, limits "
          "and locks: their step has one round; give the contact as a constraint, or leave them "
          "out");
}

}  // namespace twinarm
