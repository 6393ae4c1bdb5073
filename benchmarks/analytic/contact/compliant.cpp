// E18: the block of E2 slides down its incline on rigid and on compliant contacts.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kTilt = std::numbers::pi / 6, kGrip = 0.5, kSliderMass = 2, kSliderHalf = 0.1;
constexpr double kPointStiffness = 1e6;  // of one of four contact points [N/m]
const double kDownhill = kGravity * (std::sin(kTilt) - kGrip * std::cos(kTilt));  // [m/s^2]
const double kRestDepth = kSliderMass * kGravity * std::cos(kTilt) / (4 * kPointStiffness);  // [m]

// After 1 s; x points downhill.
struct Slid {
  double way = 0, depth = 0;  // [m]
};
Slid slid(ContactResponse response, double mu, double stiffness = kPointStiffness) {
  ContactScene scene(tilted_gravity(kTilt));
  scene.response = response;
  ContactSurface soft = surface(mu);
  soft.stiffness = 2 * stiffness;  // two surfaces in series
  const int block = scene.start_on_floor(
      {Box{Vector3::Constant(2 * kSliderHalf)}, soft, kSliderMass, {0, 0, kSliderHalf}});
  scene.run(1, kStep);
  if (!scene.ok()) return {NAN, NAN};
  return {scene.p(block).x(), kSliderHalf - scene.p(block).z()};
}

CaseResult way_of_both(double scale) {  // mu
  double error = 0;
  for (const ContactResponse response : {ContactResponse::rigid, ContactResponse::compliant})
    error = std::max(error, relative(slid(response, scale * kGrip).way, kDownhill / 2));
  return {error};
}
CaseResult depth_of_both(double scale) {  // stiffness
  const Slid compliant = slid(ContactResponse::compliant, kGrip, scale * kPointStiffness);
  const Slid rigid = slid(ContactResponse::rigid, kGrip);
  return {std::max(relative(compliant.depth, kRestDepth), std::abs(rigid.depth) / kRestDepth)};
}

}  // namespace

CaseFamily compliant_cases() {
  const auto exact_way = [](std::size_t, double t) { return kDownhill * t * t / 2; };
  const auto exact_depth = [](std::size_t k, double) { return k == 0 ? -kRestDepth : 0; };
  const auto sinking = [](Scene s) { return Values{s.p(1).z() - kSliderHalf}; };
  const Plot both = Plot{}
                        .with(&Plot::until, 1)
                        .without_convergence("Two laws of contact beside each other, at one step.");
  return {295,
          {contact_case<way_of_both, 2>("E18-way", 4e-3,
                                        both.with(&Plot::readings, {"x [m]"})
                                            .with(&Plot::read, place<1, 0>)
                                            .with(&Plot::exact, exact_way)
                                            .of_runs({"rigid", "compliant"})),
           contact_case<depth_of_both, 5>("E18-depth", 1e-3,
                                          both.with(&Plot::readings, {"z of the lower face [m]"})
                                              .with(&Plot::read, sinking)
                                              .with(&Plot::exact, exact_depth)
                                              .of_runs({"compliant", "rigid"}))}};
}

}  // namespace twinarm
