// Linear theory of couplings about a pose, e = q_K - q_D:  M e'' + B_q e' + K_q e = M q_K''
// (docs/understand/stability_of_spring_dampers.md). Includes all headers of the folder.
#pragma once

#include "coupling/analysis/gains.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/analysis/multi_joint_tracking.h"
#include "coupling/analysis/step_matrix.h"
#include "coupling/analysis/tracking.h"
