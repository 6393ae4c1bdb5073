// The wrenches on each body, and the forces that have names of their own.
#pragma once

#include "app/data/number_sheet.h"
#include "app/inspect/report/inspect_output.h"

namespace twinarm {

// "world axes, about each link's origin".
std::string viewpoint_in_words(const InspectView& view);

void write_balances(const Inspection& in, const InspectView& view, Sheet& sheet);
void write_named_forces(const Inspection& in, const InspectView& view, Sheet& sheet);

}  // namespace twinarm
