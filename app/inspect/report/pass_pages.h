// The equations of table 7.1 for one body, with the numbers put in.
#pragma once

#include "app/data/number_sheet.h"
#include "app/inspect/cross_checks.h"
#include "app/inspect/inspection.h"

namespace twinarm {

// A number, or several in brackets.
std::string name_of_number(const Eigen::VectorXd& v);
// Of a unit "angular; linear": that of the body's joint. Empty where it has several velocities.
std::string unit_at_joint(const Inspection& in, std::size_t body, std::string_view unit);

// Which joint carries the body, and where it stands.
void write_body_head(const Inspection& in, std::size_t body, Sheet& sheet);
// The quantities of a pass (1 to 3), each by its equation, in the order in which they are found.
// `D_error`: of the cross-check of D.
void write_pass(const Inspection& in, int pass, std::size_t body, double D_error, Sheet& sheet);

}  // namespace twinarm
