// What theory says of a coupling before it is run (docs/coupling.md). One door to
//   prediction_stiffness.h  K_q and B_q of what pushes, with its geometric part; modes
//   prediction_limits.h     the largest stable step and stiffness of each scheme
//   prediction_step.h       the same of several couplings as an integrator really steps them
//   prediction_tracking.h   the error behind a target that moves
//   prediction_chain.h      the same of each joint of a chain
//   prediction_contact.h    sag, the torque of a point spring, series stiffness against a wall
//
// About a pose, with e = q_K - q_D:  M e'' + B_q e' + K_q e = M q_K''.
#pragma once

#include "coupling/prediction_chain.h"
#include "coupling/prediction_contact.h"
#include "coupling/prediction_limits.h"
#include "coupling/prediction_step.h"
#include "coupling/prediction_stiffness.h"
#include "coupling/prediction_tracking.h"
