// Detection keeps the contacts of pairs that have not moved.
#include <doctest/doctest.h>

#include <string>
#include <tuple>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

TEST_CASE("contacts do not depend on what was detected before, whatever has moved since") {
  const auto fill = [](CollisionWorld& world) {
    world.add({"floor", HalfSpace{}});
    for (int i = 0; i < 12; ++i)
      world.add(
          {"b" + std::to_string(i), i % 2 == 0 ? Shape(Sphere{0.1}) : Shape(Box{{0.2, 0.2, 0.2}})});
  };
  CollisionWorld kept;
  fill(kept);
  Random random(12);
  const auto place = [&] {
    return Pose{turn(random.uniform(-3, 3), Vector3::UnitX()),
                {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0, 0.3)}};
  };
  std::vector<Pose> X_WG(13, origin);
  std::vector<double> margins(13, 1e-3);
  for (std::size_t i = 1; i < 13; ++i) X_WG[i] = place();
  for (int step = 0; step < 200; ++step) {
    const auto changed = static_cast<std::size_t>(1 + step % 12);
    if (step % 3 == 0) X_WG[changed] = place();
    if (step % 3 == 1) margins[changed] = random.uniform(0, 0.05);
    CollisionWorld fresh;
    fill(fresh);
    std::vector<Contact> contacts, expected;
    kept.detect(X_WG, margins, contacts);
    fresh.detect(X_WG, margins, expected);
    REQUIRE(contacts.size() == expected.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact &c = contacts[i], &e = expected[i];
      CHECK(std::tie(c.a, c.b, c.feature, c.depth) == std::tie(e.a, e.b, e.feature, e.depth));
      CHECK((c.p_WC == e.p_WC && c.n_W == e.n_W));
    }
  }
}
