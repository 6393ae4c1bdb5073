// The equations of table 7.1 for one body, with the numbers put in.
#pragma once

#include "app/data/number_sheet.h"
#include "app/inspect/cross_checks.h"
#include "app/inspect/displayed_quantities.h"
#include "app/inspect/inspection.h"

namespace twinarm {

// Which joint carries the body, and where it stands.
void write_body_head(const Inspection& in, std::size_t body, Sheet& sheet);

void write_first_pass(const Inspection& in, std::size_t body, Sheet& sheet);
// `D_error`: of the second way to D.
void write_second_pass(const Inspection& in, std::size_t body, double D_error, Sheet& sheet);
void write_third_pass(const Inspection& in, std::size_t body, Sheet& sheet);

}  // namespace twinarm
