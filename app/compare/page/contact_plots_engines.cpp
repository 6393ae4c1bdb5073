// Tasks of other engines: H1.
#include "app/compare/page/contact_readings.h"

namespace twinarm::compare_page::contact_look {
namespace {

constexpr const char* kPublished =
    "Run in the step of the published figures alone, 1 ms; other engines beside: docs/peers.md.";

// The box, pulled with 150 N, and the ball in a corner.
Values box_and_ball(Scene s) {
  return {s.v(1).norm(), s.v(2).norm()};
}
double rolling_on_box(std::size_t k, double t) {
  const double pull = 150 - 0.4 * (10 + 25) * kGravity, ball = pull / 10 / (3.5 + 25 / 10.);
  return t * (k == 0 ? (pull - 25 * ball) / 10 : ball);
}
// Falls by 4.9 m, e = 1.
double bouncing_ball(std::size_t, double t) {
  const double fall = std::sqrt(2 * 4.9 / kGravity), since = std::remainder(t, 2 * fall);
  return 5 - kGravity * since * since / 2;
}
Values lowest_and_top(Scene s) {
  return {s.p(1).z(), s.p(216).z()};
}

}  // namespace

std::vector<ContactLook> engines() {
  const std::vector<std::string> speeds = {"box [m/s]", "ball [m/s]"};
  const std::vector<std::string> heights = {"first ball [m]", "last ball [m]"};
  return {
      {.name = "H1-rolling-y",
       .readings = speeds,
       .read = box_and_ball,
       .exact = rolling_on_box,
       .no_steps = kPublished},
      {.name = "H1-rolling-xy",
       .readings = speeds,
       .read = box_and_ball,
       .exact = rolling_on_box,
       .no_steps = kPublished},
      {.name = "H1-bouncing",
       .readings = {"height [m]"},
       .read = place<1, 2>,
       .exact = bouncing_ball,
       .until = 8,
       .no_steps = kPublished},
      {.name = "H1-666", .readings = heights, .read = lowest_and_top, .no_steps = kPublished},
      {.name = "H1-666-elastic",
       .readings = heights,
       .read = lowest_and_top,
       .no_steps = kPublished},
  };
}

}  // namespace twinarm::compare_page::contact_look
