// Batch kernel for one instruction set (TWINARM_ISA), compiled once for each.
#include "coupling/batch/kernel/batch_kernel.h"

namespace twinarm::TWINARM_ISA {

void run_batch(BatchWork<Batch<kNativeLanes>>& work);
[[gnu::flatten]] void run_batch(BatchWork<Batch<kNativeLanes>>& work) {
  run_steps(work);
}

}  // namespace twinarm::TWINARM_ISA
