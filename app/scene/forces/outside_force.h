// A force that no scene knows, such as a mouse's, with books of its own: they are added to those of
// the run, so that both ledgers close.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/dynamics/energy_momentum.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class OutsideForce : public ForceSource, public Rewindable {
 public:
  virtual std::string name() const = 0;  // of its rows
  // A step of h that went from `start` by way of `inner` to `end`: the states that the ledger looks
  // at, with the weights of its rule for integrals over the step.
  virtual void book(double h, std::span<const double> weights, const State<double>& start,
                    const std::vector<State<double>>& inner, const State<double>& end) = 0;
  // What it did since the start, by bodies that it acted on.
  struct Given {
    int body = 0;
    Exchange exchange;
  };
  virtual const std::vector<Given>& given() const = 0;
  // Those, both ways. Until it has acted they have no part in what a run remembers.
  virtual void visit_books(Memory& memory) = 0;

  bool has_acted() const { return !given().empty(); }
  Exchange total() const {
    Exchange sum;
    for (const Given& part : given()) sum += part.exchange;
    return sum;
  }
};

}  // namespace twinarm
