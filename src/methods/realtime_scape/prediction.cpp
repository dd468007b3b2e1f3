#include "methods/realtime_scape/prediction.h"

#include <cmath>

#include "math/rotation.h"

namespace vitruvia::realtime_scape {
namespace {

// The position of a joint as one of its bones moves it (camera frame).
Vector3d JointUnder(const Model& model, const BodyPose& pose, int bone, int joint) {
  return pose[bone].center +
         pose[bone].rotation * (model.skeleton.joints[joint] - model.rest_centers[bone]);
}

}  // namespace

Prediction PredictPose(const Model& model, const PoseHistory& history,
                       const MotionSettings& settings) {
  const BodyPose& last = history.last;
  Prediction prediction{last, LocalRotationsOf(last)};
  if (settings.model == MotionModel::kConstantRotation) return prediction;

  const LocalRotations before = LocalRotationsOf(history.before_last);
  for (int j = 0; j < kBoneCount; ++j) {
    const double share = settings.velocity_share *
                         std::pow(settings.hidden_decay, history.visibility.frames_unobserved[j]);
    Matrix3<double>& local = prediction.local_rotations[j];
    const Matrix3<double> change = RelativeRotation(before[j], local);
    local = local * ExpSo3<double>(share * LogSo3<double>(change));

    BonePose& bone = prediction.pose[j];
    const int parent = Bones()[j].parent;
    if (parent < 0) {
      bone.rotation = local;
      bone.center += share * (last[j].center - history.before_last[j].center);
      continue;
    }
    const Vector3d gap = JointUnder(model, last, j, j) - JointUnder(model, last, parent, j);
    bone.rotation = prediction.pose[parent].rotation * local;
    bone.center = JointUnder(model, prediction.pose, parent, j) + gap -
                  bone.rotation * (model.skeleton.joints[j] - model.rest_centers[j]);
  }
  return prediction;
}

}  // namespace vitruvia::realtime_scape
