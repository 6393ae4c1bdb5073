#include "benchmarks/analytic/support/chain_parts.h"

namespace twinarm::smooth_parts {

Model<double> plane_chain(const std::vector<ChainLink>& links, double gravity) {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -gravity});
  int parent = 0;
  double down = 0;
  for (const ChainLink& link : links) {
    const std::string number = std::to_string(parent + 1);
    const Vector3 moments(link.inertia, link.inertia, link.in_line ? 0 : link.inertia);
    parent = builder.add_body("link" + number, parent, "joint" + number, JointType::revolute,
                              {Matrix3::Identity(), {0, 0, -down}}, -Vector3::UnitY(),
                              {link.mass, {0, 0, -link.com}, moments.asDiagonal()});
    down = link.length;
  }
  return builder.build();
}

Model<double> plane_chain(const ChainLink& link, int count) {
  return plane_chain(std::vector<ChainLink>(static_cast<std::size_t>(count), link));
}

CaseObserver absolute_angles() {
  return [](const Model<double>&, const State<double>& x) {
    CaseReadings all;
    for (const std::vector<double>& joints : {x.q, x.qd}) {
      double sum = 0;
      for (const double joint : joints) all.push_back(sum += joint);
    }
    return all;
  };
}

std::function<CaseReadings(double)> solution_of(special::Rates rates, special::Numbers start) {
  return [rates = std::move(rates), start = std::move(start)](double t) {
    CaseReadings all;
    for (const long double value : special::solution(rates, start, t))
      all.push_back(static_cast<double>(value));
    return all;
  };
}

}  // namespace twinarm::smooth_parts
