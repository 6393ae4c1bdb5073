// Small words that the pages of the passes share.
#pragma once

#include <string>

#include "app/data/number_sheet.h"
#include "app/inspect/displayed_quantities.h"
#include "app/inspect/inspection.h"

namespace twinarm {

// A number, or several in brackets.
std::string name_of_number(const Eigen::VectorXd& v);
// In brackets where a minus stands before it.
std::string subtracted(double value, double scale);
// "_base" or "_p".
std::string of_parent(const Inspection& in, std::size_t body);
// Of a joint of one degree of freedom; empty where it has several.
const char* joint_unit(const Inspection& in, std::size_t body, const char* turn, const char* shift);
// "S", or "S[1]", "S[2]" ..
void write_columns(Sheet& sheet, const char* name, const Eigen::MatrixXd& columns,
                   const Vector6& size);

}  // namespace twinarm
