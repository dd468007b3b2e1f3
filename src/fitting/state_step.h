// One Gauss–Newton step of a body's state within the joint limits.
#pragma once

#include "fitting/shaped_body.h"

namespace vitruvia {

// The x that minimises xᵀHx + 2gᵀx over the first `free_count` parameters of PosedBody, with the
// others kept at 0. An angle that the step would move beyond its limit is held at the limit, and
// the others are solved for again. `hessian` is symmetric and positive definite; both cover all
// parameters.
Eigen::VectorXd SolveWithinLimits(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                                  const AngleVector& angles_deg, int free_count);

// The step (of pose, position and possibly shape), shortened so that no angle changes by more than
// 0.6 rad and the position by no more than 0.6 m per axis, where the linearisation is valid.
Eigen::VectorXd NoLongerThanLinear(Eigen::VectorXd step);

// The state moved by a step in the parameters of PosedBody, of which the shape may be left out; its
// angles stay within their limits.
BodyState Moved(BodyState state, const Eigen::VectorXd& step);

}  // namespace vitruvia
