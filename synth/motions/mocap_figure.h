// Checks whether twelve joints and a head form an upright person, and finds its up and front
// directions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "synth/motions/mocap_joints.h"

namespace vitruvia {

// The directions of a standing person, orthonormal: left × up = front.
struct FigureAxes {
  Vector3<double> left, up, front;

  Matrix3<double> Rows() const;  // figure_from_file
};

// Orthonormalises left and up; up is kept.
FigureAxes AxesFrom(const Vector3<double>& left, const Vector3<double>& up);

// From the middle of the ankles to the middle of the hips.
Vector3<double> LegsUp(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// From the right hip to the left one.
Vector3<double> HipsLeft(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// "" if the positions are those of an upright person in any axes: legs nearly straight under the
// trunk, head above the hips, left shoulder above the left hip. Otherwise the condition that fails,
// with the angle.
std::string FigureProblem(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// Similarity of a standing figure to the T-pose: 1 for a T-pose, lower for a leaning trunk and bent
// limbs. Used to choose among frames.
double TPoseLikeness(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// Mean length of both legs.
double LegLength(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

}  // namespace vitruvia
