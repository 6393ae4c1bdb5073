// Equations of the passes with their numbers, term by term (RBDA table 7.1).
//
// Terms are computed here by matrix products in link axes; the left side is aba()'s result, so the
// residual tests the passes. aba() does not store c, p and a': these are the sums of their terms.
// Cost O(children) of a body.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"

namespace twinarm {

struct EquationTerm {
  std::string symbol;     // "Xup v_p"
  const char* words;      // meaning
  std::size_t of;         // body that contributes it
  Eigen::MatrixXd value;  // 6 x 1, 6 x 6, nv x 1, nv x nv, 6 x nv
  double size = 0;        // of a product: size of its factors, the scale of its rounding error
};

struct Equation {
  std::string name;  // of the left side: "v", "D qdd"
  std::string text;  // "v = Xup v_p + S qd"
  std::vector<EquationTerm> terms;
  Eigen::MatrixXd value;
  bool by_columns = false;  // 6 x nv, a column for each velocity of the joint
  double residual = 0;      // max |sum of terms - value|, relative to the largest size
};

// Of a pass (1 to 3) at a body, in the order of computation. Link axes, about the link's origin;
// joint values as on the command line.
std::vector<Equation> equations_of(const Inspection& in, int pass, std::size_t body);

}  // namespace twinarm
