// Cross-check of the predictions of coupling/ by MuJoCo: stability limit of a hinge on a
// spring-damper, by bisection; motion of a constraint with a solref; tracking error of a body that
// is welded to a moving mocap body. Prints predicted and measured values; exit code 1 if one
// exceeds its tolerance.
//
// The spring-damper is an actuator (explicit in every integrator), or stiffness and damping of the
// joint, whose damper is implicit in MuJoCo's Euler.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "benchmarks/engines/mujoco_model.h"
#include "coupling/analysis/gains.h"
#include "coupling/analysis/prediction.h"

namespace {

using namespace twinarm;

constexpr double kInertia = 0.7, kStep = 0.01;

struct MuJoCo : bench::MujocoRun {
  explicit MuJoCo(const std::string& xml) : MujocoRun({{"scene.xml", xml}}) {}
  void step() { mj_step(model.get(), data.get()); }
  double& q() { return data->qpos[0]; }
};

std::string number(double value) {
  return bench::mjcf(std::array{value});
}

// One body on this joint; `bodies` before it, `rest` after the world.
std::string scene(double h, const std::string& integrator, const std::string& joint,
                  const std::string& rest = "", const std::string& bodies = "") {
  return "<mujoco><option gravity=\"0 0 0\" timestep=\"" + number(h) + "\" integrator=\"" +
         integrator + "\"/><worldbody>" + bodies + "<body name=\"link\"><joint name=\"j\" " +
         joint + "/><inertial pos=\"0 0 0\" mass=\"" + number(kInertia) + "\" diaginertia=\"" +
         number(kInertia) + number(kInertia) + number(kInertia) + "\"/></body></worldbody>" + rest +
         "</mujoco>";
}
const std::string hinge = "type=\"hinge\" axis=\"0 0 1\"";

struct Row {
  SteppingScheme scheme;
  const char* integrator;
  bool actuator;
};

std::string spring_damper(const Row& row, double k, double b) {
  if (!row.actuator)
    return scene(kStep, row.integrator,
                 hinge + " stiffness=\"" + number(k) + "\" damping=\"" + number(b) + "\"");
  return scene(kStep, row.integrator, hinge,
               "<actuator><general joint=\"j\" gainprm=\"0\" biastype=\"affine\" biasprm=\"0 " +
                   number(-k) + number(-b) + "\"/></actuator>");
}

bool grows(const Row& row, double wh, double zeta) {
  const double w = wh / kStep;
  const SpringGains gains = gains_of(SpringResponse{w, zeta}, kInertia);
  MuJoCo engine(spring_damper(row, gains.k, gains.b));
  engine.q() = 1e-9;
  double early = 0, late = 0;
  constexpr int steps = 4000;
  for (int n = 0; n < steps; ++n) {
    engine.step();
    const double size = std::abs(engine.q());
    if (!(size < 1e-3)) return true;
    if (n >= steps / 4 && n < steps / 2) early = std::max(early, size);
    if (n >= 3 * steps / 4) late = std::max(late, size);
    if (size < 1e-15 && n > steps / 4) return false;
  }
  return late > 1.01 * early;
}

bool report(const std::string& what, double predicted, double measured, double tolerance) {
  const double error = measured / predicted - 1;
  const bool good = std::abs(error) <= tolerance;
  std::printf("%-52s %12.6g %12.6g %10.2e  %s\n", what.c_str(), predicted, measured, error,
              good ? "" : "FAIL");
  return good;
}

bool limits() {
  const Row rows[] = {{SteppingScheme::semi_implicit, "Euler", true},
                      {SteppingScheme::implicit_damper, "Euler", false},
                      {SteppingScheme::rk4, "RK4", true}};
  bool good = true;
  for (const Row& row : rows)
    for (const double zeta : {0.0, 0.7, 1.0}) {
      const double predicted = max_omega_h(row.scheme, zeta);
      double inside = 0.8 * predicted, outside = 1.2 * predicted;
      while (outside - inside > 1e-5 * predicted) {
        const double middle = (inside + outside) / 2;
        (grows(row, middle, zeta) ? outside : inside) = middle;
      }
      char what[100];
      std::snprintf(what, sizeof what, "limit of w h, %s, z = %g", name_of(row.scheme), zeta);
      good = report(what, predicted, inside, 0.005) && good;
    }
  return good;
}

// A joint with an equality constraint, from 0.01 rad at rest, over two periods.
bool constraints() {
  bool good = true;
  const Solref solrefs[] = {{0.02, 1}, {0.05, 0.3}, {-900, -12}};
  const MujocoImpedance impedances[] = {{0.95, 0.95}, {0.5, 0.8}};
  for (const Solref& solref : solrefs)
    for (const MujocoImpedance& impedance : impedances) {
      const SpringResponse response = response_of(gains_of(solref, kInertia, impedance), kInertia);
      const double h = 1e-5;
      // solimp: dmin, dmax and a width with which d = dmin for errors of this size.
      const std::string solimp = number(impedance.d) + number(impedance.d_max) + "1e6 0.5 2";
      MuJoCo engine(scene(h, "RK4", hinge,
                          "<equality><joint joint1=\"j\" polycoef=\"0 0 0 0 0\" solref=\"" +
                              number(solref.first) + number(solref.second) + "\" solimp=\"" +
                              solimp + "\"/></equality>"));
      engine.q() = 0.01;
      const double r = response.omega * std::sqrt(std::abs(1 - response.zeta * response.zeta));
      const double zw = response.zeta * response.omega;
      double worst = 0;
      const auto steps = static_cast<int>(2 * 6.2832 / response.omega / h);
      for (int n = 1; n <= steps; ++n) {
        engine.step();
        const double t = n * h;
        const double c = r * t < 1e-6 || response.zeta > 0.999999 ? 1 : std::cos(r * t);
        const double s = r * t < 1e-6 || response.zeta > 0.999999 ? t : std::sin(r * t) / r;
        worst = std::max(worst, std::abs(engine.q() - 0.01 * std::exp(-zw * t) * (c + zw * s)));
      }
      char what[100];
      std::snprintf(what, sizeof what, "solref %g %g at d = %g of %g: 1 + largest error / 0.01",
                    solref.first, solref.second, impedance.d, impedance.d_max);
      good = report(what, 1, 1 + worst / 0.01, 0.005) && good;
    }
  return good;
}

bool weld_error() {
  const double timeconst = 0.05, v = 0.3, h = 1e-4;
  MuJoCo engine(scene(h, "Euler", "type=\"slide\" axis=\"1 0 0\"",
                      "<equality><weld body1=\"hand\" body2=\"link\" solref=\"" +
                          number(timeconst) + "1\" solimp=\"0.95 0.95 0.001 0.5 2\"/></equality>",
                      "<body name=\"hand\" mocap=\"true\"/>"));
  for (int n = 1; n <= 20000; ++n) {
    engine.data->mocap_pos[0] = v * n * h;
    engine.step();
  }
  return report("tracking error of a mocap weld, 2 v timeconst [m]", mocap_weld_error(v, timeconst),
                engine.data->mocap_pos[0] - engine.q(), 0.01);
}

}  // namespace

int main() {
  std::printf("MuJoCo %s\n%-52s %12s %12s %10s\n", mj_versionString(), "", "predicted", "measured",
              "error");
  const bool good = limits();
  const bool moved = constraints();
  return weld_error() && good && moved ? 0 : 1;
}
