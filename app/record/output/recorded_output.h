// What `twinarm export` prints of a recording.
#pragma once

#include "app/record/recording_reader.h"

namespace twinarm {

void print_recording_csv(const Recording& recording);
void print_recording_json(const Recording& recording);

}  // namespace twinarm
