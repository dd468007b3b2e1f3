// Whether twelve joints and a head are a person who stands upright, and which way is up and front.
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

// Left and up are made orthogonal: up counts.
FigureAxes AxesFrom(const Vector3<double>& left, const Vector3<double>& up);

// From the middle of the ankles to the middle of the hips.
Vector3<double> LegsUp(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// From the right hip to the left one.
Vector3<double> HipsLeft(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// "" if the positions are those of somebody who stands upright, whatever the axes: legs straight
// enough under the trunk, head above the hips, left shoulder above the left hip. Otherwise what is
// not so, with the angle.
std::string FigureProblem(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// How near a standing figure comes to the T-pose: 1 if it is one, less the more its trunk leans and
// its limbs are bent. Used to choose among frames.
double TPoseLikeness(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

// Mean length of both legs.
double LegLength(const std::vector<Vector3<double>>& positions, const MocapJoints& joints);

}  // namespace vitruvia
