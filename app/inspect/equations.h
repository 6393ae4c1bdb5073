// The equations of the passes with their numbers in, term by term (RBDA table 7.1).
//
// Each term is computed anew, in link axes and by plain products of matrices; the left side is what
// aba() has. So what is left between the two is a test of the passes, but for sums that aba() does
// not keep: c, p and a' are made of their terms.
// Cost O(children) of a body.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"

namespace twinarm {

struct EquationTerm {
  std::string symbol;     // "Xup v_p"
  const char* words;      // what it is
  std::size_t of;         // the body that hands it over; the body itself where nobody does
  Eigen::MatrixXd value;  // 6 x 1, 6 x 6, nv x 1, nv x nv, 6 x nv
  double size = 0;        // of a product: of what it sums up, beside which rounding is nothing
};

struct Equation {
  std::string name;  // of the left side: "v", "D qdd"
  std::string text;  // "v = Xup v_p + S qd"
  std::vector<EquationTerm> terms;
  Eigen::MatrixXd value;
  bool by_columns = false;  // 6 x nv, a column for each velocity of the joint
  double residual = 0;  // largest number of terms less value, as a part of the largest of all sizes
};

// Of a pass (1 to 3) at a body, in the order in which they are used. Link axes, about the link's
// origin; joint values as on the command line.
std::vector<Equation> equations_of(const Inspection& in, int pass, std::size_t body);

}  // namespace twinarm
