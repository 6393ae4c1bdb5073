#include "collision/contact/contact_work.h"

#include <algorithm>
#include <utility>

namespace twinarm {

ContactWork& ContactWorks::of(int a, int b) {
  const std::pair pair(a, b);
  auto w = std::lower_bound(all.begin(), all.end(), pair, [](const ContactWork& work, auto ab) {
    return std::pair(work.a, work.b) < ab;
  });
  if (w == all.end() || std::pair(w->a, w->b) != pair)
    w = all.insert(w, {a, b, 0, 0, 0, Vector3::Zero(), Vector3::Zero()});
  return *w;
}

void ContactWorks::visit_memory(Memory& memory, std::size_t count) {
  constexpr std::size_t kWork = 9 * sizeof(double);  // bytes, at least
  memory.resize(all, kWork);
  for (ContactWork& work : all) {
    for (int* id : {&work.a, &work.b}) memory.visit_index(*id, count);
    for (double* joules : {&work.normal, &work.friction, &work.impact}) memory.visit(*joules);
    memory.visit(work.impulse_W), memory.visit(work.moment_W);
  }
}

}  // namespace twinarm
