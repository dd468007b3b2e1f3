// How a pose takes the step that the linear solver found.
#pragma once

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/settings.h"

namespace vitruvia::realtime_scape {

// The rotation after a step (radians, camera frame).
Matrix3<double> Turned(const Matrix3<double>& rotation, const Vector3<double>& step,
                       RotationUpdate update);

// Whether some bone's rotation is none any more, beyond what a linear update may do in a frame, or
// a bone has left for where no camera looks.
bool IsTornApart(const BodyPose& pose);

}  // namespace vitruvia::realtime_scape
