#include "support/arm_stage.h"

#include "math/rigid.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {

ArmStage::ArmStage(int subdivisions, Skin skin, const Rigidd& camera_from_subject)
    : body(Refine(MakeControlBody(BodySettings{}), {.subdivisions = subdivisions})),
      skin_(skin),
      camera_from_subject_(camera_from_subject) {}

std::vector<Vector3f> ArmStage::Vertices(double angle_rad) const {
  JointPose pose = JointPose::Rest(body.skeleton);
  const auto turn = [&](BoneId bone, const Vector3d& axis) {
    pose.local_rotations[static_cast<int>(bone)] = ExpSo3<double>(angle_rad * axis);
  };
  turn(BoneId::kLeftUpperArm, -Vector3d::UnitZ());
  turn(BoneId::kRightForearm, Vector3d::UnitY());
  BoneTransforms bones = ForwardKinematics(body.skeleton, pose);
  for (Rigidd& bone : bones) bone = camera_from_subject_ * bone;
  std::vector<Vector3f> vertices;
  skin_(body.rest.vertices, body.weights, bones, vertices);
  return vertices;
}

DepthFrame ArmStage::Frame(int index, double angle_rad) {
  return {index, index / 30.0, zbuffer.Render(Vertices(angle_rad), body.rest.triangles)};
}

double ArmStage::MeanError(const TrackResult& result, double angle_rad) const {
  const std::vector<Vector3f> truth = Vertices(angle_rad);
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += (truth[i] - result.vertices[i]).norm();
  return sum / static_cast<double>(truth.size());
}

}  // namespace vitruvia
