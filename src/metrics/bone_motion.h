// Bone rotations estimated from surfaces alone, for jitter and twist metrics that apply to any
// method and to the truth.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

using BoneRotations = std::vector<Matrix3<double>>;  // posed_from_rest, one for each bone

// The vertices that move rigidly with each bone, and their rest positions.
class RigidParts {
 public:
  // bone_of_vertex[i] < 0: vertex i belongs to no bone. A bone needs three vertices not in a line.
  RigidParts(const std::vector<Vector3f>& rest_vertices, const std::vector<int>& bone_of_vertex,
             int bone_count);

  // The least-squares rotation of each part's rest positions onto the posed ones (Kabsch 1976); the
  // identity for a bone without enough vertices.
  BoneRotations Rotations(const std::vector<Vector3f>& posed) const;

 private:
  std::vector<std::vector<int>> vertices_;
  std::vector<Vector3f> rest_;
};

// Angular acceleration of bone `bone` at frame i ≥ 2, rad/s², from three frames.
Vector3d AngularAcceleration(const std::vector<BoneRotations>& frames, std::size_t i,
                             std::size_t bone, double fps);

// Root mean square over bones and frames of the difference between the angular accelerations of
// estimate and truth, rad/s². 0 with fewer than three frames.
double AngularJitter(const std::vector<BoneRotations>& estimate,
                     const std::vector<BoneRotations>& truth, double fps);

// The angle, in (−π, π], by which `rotation` turns about the unit axis (swing-twist decomposition).
double TwistAbout(const Matrix3<double>& rotation, const Vector3d& axis);

// Root mean square, over frames and the bones with a non-zero axis, of the estimate's twist
// relative to the truth about the bone's rest-pose axis, radians.
double TwistError(const std::vector<BoneRotations>& estimate,
                  const std::vector<BoneRotations>& truth, const std::vector<Vector3d>& axes);

}  // namespace vitruvia
