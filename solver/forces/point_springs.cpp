#include "solver/forces/point_springs.h"

#include "solver/forces/spring.h"

namespace twinarm {

PointSprings::Reading PointSprings::reading(std::size_t i, const State<double>& x,
                                            const Kinematics& k) noexcept {
  PointSpring& spring = springs_[i];
  Reading now;
  now.p_A = k.position(spring.a.body, spring.a.p_L);
  now.p_B = k.position(spring.b.body, spring.b.p_L);
  const Vector3 line = now.p_B - now.p_A;
  now.length = line.norm();
  if (now.length > 0) now.direction = line / now.length;
  now.rate =
      now.direction.dot(k.velocity(spring.b.body, now.p_B) - k.velocity(spring.a.body, now.p_A));
  now.elastic = spring.stiffness * (now.length - spring.rest_length);
  now.damping = spring.damping * now.rate;
  if (spring.law) now.law = (*spring.law)(std::array{now.length, now.rate, x.t})[0];
  return now;
}

void PointSprings::add_forces(const State<double>& x, const Kinematics& k,
                              Forces<double>& forces) noexcept {
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const Reading now = reading(i, x, k);
    const Vector3 f_W = now.tension() * now.direction;
    add_point_force(k, springs_[i].a.body, now.p_A, f_W, forces);
    add_point_force(k, springs_[i].b.body, now.p_B, -f_W, forces);
  }
}

}  // namespace twinarm
