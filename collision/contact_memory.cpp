// What contacts remember from step to step (solver/memory.h): bristles, guesses, what is held, and
// the work so far.
#include "collision/contact_constraints.h"

namespace twinarm {

void ContactConstraints::visit_memory(Memory& memory) {
  memory.visit(locates_);
  memory.resize(points_, sizeof(double));
  for (ContactPoint& p : points_) {
    for (int* id : {&p.contact.a, &p.contact.b, &p.contact.feature}) memory.visit(*id);
    for (double* number : {&p.contact.depth, &p.friction, &p.restitution, &p.compliance.stiffness,
                           &p.compliance.dissipation})
      memory.visit(*number);
    for (Vector3* v : {&p.contact.p_WC, &p.contact.n_W, &p.impulse_W, &p.force_W, &p.couple_W,
                       &p.anchor_W, &p.velocity_W, &p.slip_W})
      memory.visit(*v);
    memory.visit(p.is_held);
    memory.visit(p.opens);
  }
  memory.resize(work_, sizeof(double));
  for (ContactWork& work : work_) {
    memory.visit(work.a), memory.visit(work.b);
    for (double* joules : {&work.normal, &work.friction, &work.impact}) memory.visit(*joules);
    memory.visit(work.impulse_W), memory.visit(work.moment_W);
  }
}

}  // namespace twinarm
