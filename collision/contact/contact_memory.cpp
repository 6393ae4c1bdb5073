// What contacts remember from step to step (solver/support/state_archive.h): bristles, guesses,
// what is held, and the work so far.
#include "collision/contact/contact_constraints.h"

namespace twinarm {

void ContactConstraints::visit_memory(Memory& memory) {
  constexpr std::size_t kPoint = 28 * sizeof(double),
                        kWork = 9 * sizeof(double);  // bytes, at least
  const auto count = static_cast<std::size_t>(world_.size());
  memory.visit(locates_);
  memory.resize(points_, kPoint);
  for (ContactPoint& p : points_) {
    for (int* id : {&p.contact.a, &p.contact.b}) memory.visit_index(*id, count);
    memory.visit(p.contact.feature);
    for (double* number : {&p.contact.depth, &p.friction, &p.restitution, &p.compliance.stiffness,
                           &p.compliance.dissipation})
      memory.visit(*number);
    for (Vector3* v : {&p.contact.p_WC, &p.contact.n_W, &p.impulse_W, &p.force_W, &p.couple_W,
                       &p.anchor_W, &p.velocity_W, &p.slip_W})
      memory.visit(*v);
    memory.visit(p.is_held);
    memory.visit(p.opens);
  }
  memory.resize(work_, kWork);
  for (ContactWork& work : work_) {
    for (int* id : {&work.a, &work.b}) memory.visit_index(*id, count);
    for (double* joules : {&work.normal, &work.friction, &work.impact}) memory.visit(*joules);
    memory.visit(work.impulse_W), memory.visit(work.moment_W);
  }
}

}  // namespace twinarm
