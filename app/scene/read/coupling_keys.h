// Which keys a coupling of a scene has, by its type: for whoever changes the type of one.
#pragma once

#include "app/data/value.h"

namespace twinarm {

// After its `type` was changed: leaves out the keys that the new type has not, and adds what it
// must have (a stiffness of 1000; a turn_stiffness as if the stiffness had an arm of 0.1 m), in
// `line`. A type that is not known stays, for the reader to tell.
void fit_keys_to_type(Value& coupling, int line);

}  // namespace twinarm
