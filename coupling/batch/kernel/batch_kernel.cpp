// The steps of a batch at one level of the instruction set (TWINARM_ISA), with as many lanes as a
// register of that level has. Compiled once for each level (coupling/CMakeLists.txt).
#include "coupling/batch/kernel/batch_kernel.h"

namespace twinarm::TWINARM_ISA {

void run_batch(BatchWork<Batch<kNativeLanes>>& work);
[[gnu::flatten]] void run_batch(BatchWork<Batch<kNativeLanes>>& work) {
  run_steps(work);
}

}  // namespace twinarm::TWINARM_ISA
