// What theory says of a coupling before it is run (docs/understand/stability_of_spring_dampers.md).
// One door to
//   joint_space_stiffness.h  K_q and B_q of what pushes, its geometric part; modes; sag and
//                            series stiffness against a wall
//   gains.h                  the largest stable step and stiffness of each scheme; conversions
//   step_matrix.h            the same of several couplings as an integrator really steps them
//   tracking.h               the error behind a target that moves
//   multi_joint_tracking.h   the same of each joint of a chain
//
// About a pose, with e = q_K - q_D:  M e'' + B_q e' + K_q e = M q_K''.
#pragma once

#include "coupling/analysis/gains.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/analysis/multi_joint_tracking.h"
#include "coupling/analysis/step_matrix.h"
#include "coupling/analysis/tracking.h"
