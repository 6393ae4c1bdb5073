// The first non-finite variable is found in the order of computation.
#include <doctest/doctest.h>

#include <limits>

#include "solver/dynamics/dynamics.h"
#include "solver/model/non_finite.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("the first non-finite variable is reported with pass, body and name") {
  Random random(11);
  const Model<double> model = random_tree(random, 6, {JointType::revolute});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = [](const Model<double>& of, const State<double>& x,
                        const Forces<double>& forces) {
    Workspace<double> w(of);
    aba(of, x, forces, w);
    return first_bad_quantity(of, forces, w);
  };
  const State<double> good = random_state(random, model);
  const Forces<double> none(model);
  CHECK(found(model, good, none).body == 0);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    CAPTURE(i);
    State<double> x = good;
    x.qd[model.iv[i]] = nan;
    NonFiniteField bad = found(model, x, none);
    CHECK(bad.body == i);
    CHECK(bad.pass == 1);
    CHECK(std::string(bad.name) == "v");

    Forces<double> forces(model);
    forces.f_ext[i].f.y = nan;
    bad = found(model, good, forces);
    CHECK(bad.body == i);
    CHECK(bad.pass == 0);
    CHECK(std::string(bad.name) == "f_ext");

    Model<double> broken = model;
    broken.I[i].m = nan;
    bad = found(broken, good, none);
    CHECK(bad.body == i);
    CHECK(bad.pass == 2);
    CHECK(std::string(bad.name) == "IA");
  }
}

TEST_CASE("every variable of the algorithms is described once, with unit and equation") {
  Random random(12);
  const Model<double> model = random_tree(random, 3, {JointType::spherical});
  const Workspace<double> w(model);
  const FullTrace<double> trace(model.parent.size());
  const Forces<double> forces(model);
  std::vector<std::string> names;
  const auto check = [&](const Quantity& quantity, const auto& field) {
    names.emplace_back(quantity.name);
    const std::size_t size = quantity.by == Quantity::By::body       ? model.parent.size()
                             : quantity.by == Quantity::By::velocity ? model.nv
                                                                     : w.D.size();
    CHECK(field.size() == size);
    for (const char* text : {quantity.meaning, quantity.unit, quantity.equation})
      CHECK(std::string(text).size() > 0);
    CHECK(quantity.pass >= 0);
    CHECK(quantity.pass <= 3);
  };
  forces.describe(check);
  w.describe(check);
  trace.describe(check);
  const std::vector<std::string> wanted{
      "tau", "f_ext", "armature", "added_inertia", "S", "Xup", "v", "c", "IA", "pA",
      "U",   "D",     "u",        "qdd",           "a", "Ia",  "pa"};
  CHECK(names == wanted);
}
