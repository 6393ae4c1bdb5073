// Energy alarm with synthetic rows: the kind of a row decides, not its name.
#include <doctest/doctest.h>

#include <cmath>

#include "app/accounting/energy_balance.h"

using namespace twinarm;

namespace {

// A row that doubles in every window, with a kinetic energy of 1 J.
std::optional<Alarm> alarm_of(EnergyRowKind kind, const std::string& name) {
  EnergyAlarm alarm(1);
  for (int n = 0; n < 20; ++n)
    if (const auto found = alarm.look(0.1 * n, 1, {{kind, name, 1e-3 * std::pow(2, n)}}))
      return found;
  return std::nullopt;
}

}  // namespace

TEST_CASE("energy alarm: rows of numerical work raise it, whatever their names") {
  for (const EnergyRowKind kind :
       {EnergyRowKind::numerical, EnergyRowKind::coupling_implicit,
        EnergyRowKind::constraint_stabilisation, EnergyRowKind::contact_stabilisation,
        EnergyRowKind::limit_stabilisation}) {
    const std::optional<Alarm> alarm = alarm_of(kind, "another name");
    REQUIRE(alarm);
    CHECK(alarm->row == "another name");
  }
}

TEST_CASE("energy alarm: rows of physical work do not raise it, whatever their names") {
  for (const EnergyRowKind kind : {EnergyRowKind::gravity, EnergyRowKind::actuator,
                                   EnergyRowKind::wrench, EnergyRowKind::coupling_other})
    for (const char* name : {kNumericalRow, "coupling/a/implicit", "contact/stabilisation"})
      CHECK(!alarm_of(kind, name));
}
