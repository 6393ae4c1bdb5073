// `twinarm export RECORDING PAGE.html`: writes the page of replay_page.h.
#pragma once

#include "app/command/commands.h"

namespace twinarm {

// Throws InputError with all faults of the options.
int export_page(const ExportOptions& options);

}  // namespace twinarm
