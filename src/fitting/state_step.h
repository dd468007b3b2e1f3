// One Gauss–Newton step of a body's state within the joint limits.
#pragma once

#include "fitting/shaped_body.h"

namespace vitruvia {

// The x that minimises xᵀHx + 2gᵀx over the first `free_count` parameters of PosedBody, the others
// kept at 0. An angle that the step would carry beyond its limit is held there, and the others are
// solved for again. `hessian` is symmetric and positive definite; both cover all parameters.
Eigen::VectorXd SolveWithinLimits(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient,
                                  const AngleVector& angles_deg, int free_count);

// A step of pose, place and perhaps shape, shortened so that no angle moves by more than 0.6 rad
// and nothing by more than 0.6 m: linearisation holds no farther.
Eigen::VectorXd NoLongerThanLinear(Eigen::VectorXd step);

// The state moved by a step in the parameters of PosedBody, of which the shape may be left out; its
// angles stay within their limits.
BodyState Moved(BodyState state, const Eigen::VectorXd& step);

}  // namespace vitruvia
