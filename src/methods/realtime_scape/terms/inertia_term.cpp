#include "methods/realtime_scape/terms/inertia_term.h"

#include "methods/realtime_scape/terms/rotated_vector_row.h"

namespace vitruvia::realtime_scape {

void AddInertiaTerm(const BodyPose& pose, const LocalRotations& previous, double weight,
                    BlockNormalEquations& equations) {
  for (int j = 0; j < kBoneCount; ++j) {
    const int parent = Bones()[j].parent;
    const Matrix3<double> predicted =
        parent < 0 ? previous[j] : pose[parent].rotation * previous[j];
    // The squared Frobenius norm is the sum over the three columns.
    for (int column = 0; column < 3; ++column) {
      AddRotatedVectorRows(j, pose[j].rotation.col(column), parent, predicted.col(column), weight,
                           equations);
    }
  }
}

}  // namespace vitruvia::realtime_scape
