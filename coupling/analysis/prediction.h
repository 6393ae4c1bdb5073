// What theory says of a coupling before it is run (docs/coupling.md). One door to
//   joint_space_stiffness.h  K_q and B_q of what pushes, with its geometric part; modes
//   stability_limits.h     the largest stable step and stiffness of each scheme
//   step_matrix.h       the same of several couplings as an integrator really steps them
//   tracking_error.h   the error behind a target that moves
//   multi_joint_tracking.h      the same of each joint of a chain
//   static_deflection.h    sag, series stiffness against a wall
//
// About a pose, with e = q_K - q_D:  M e'' + B_q e' + K_q e = M q_K''.
#pragma once

#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/analysis/multi_joint_tracking.h"
#include "coupling/analysis/stability_limits.h"
#include "coupling/analysis/static_deflection.h"
#include "coupling/analysis/step_matrix.h"
#include "coupling/analysis/tracking_error.h"
