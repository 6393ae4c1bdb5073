// Mass, momentum and inertia of bodies, from the model in body axes B to the world.
#include "app/draw/scene_view.h"

namespace twinarm {

Vector3 com_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  if (!(I.m > 0)) return k.X_WL[body].p;
  return k.X_WL[body].p + k.R_WB[body] * to_eigen(I.h) / I.m;
}

// About the centre of mass c from that about the origin: I_c = I_o - m (c.c 1 - c c^T), c = h / m.
Matrix3 inertia_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  Matrix3 I_B;
  for (int column = 0; column < 3; ++column) {
    const Vector3 unit = Vector3::Unit(column);
    I_B.col(column) = to_eigen(I.I * from_eigen(unit));
  }
  if (I.m > 0) {
    const Vector3 h = to_eigen(I.h);
    I_B -= (h.squaredNorm() * Matrix3::Identity() - h * h.transpose()) / I.m;
  }
  return k.R_WB[body] * I_B * k.R_WB[body].transpose();
}

TotalMotion total_motion(const Model<double>& model, const Kinematics& k) {
  TotalMotion total;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Vector3 c = com_of(model, k, i);
    total.mass += m;
    total.com_W += m * c;
    total.linear += m * k.velocity(static_cast<int>(i), c);
  }
  if (!(total.mass > 0)) return total;
  total.com_W /= total.mass;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Vector3 c = com_of(model, k, i);
    const Vector3 p = m * k.velocity(static_cast<int>(i), c);
    total.angular += inertia_of(model, k, i) * k.w_WL[i] + (c - total.com_W).cross(p);
  }
  return total;
}

}  // namespace twinarm
