#include "support/small_recording.h"

#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "sequence/joint_visibility.h"

namespace vitruvia {
namespace {

constexpr double kRaisedPerFrame_rad = 0.3;

BoneTransforms BonesAt(const Skeleton& skeleton, int frame) {
  JointPose pose = JointPose::Rest(skeleton);
  pose.local_rotations[static_cast<std::size_t>(BoneId::kLeftUpperArm)] =
      Eigen::AngleAxisd(kRaisedPerFrame_rad * frame, Vector3d::UnitZ()).toRotationMatrix();
  return ForwardKinematics(skeleton, pose);
}

}  // namespace

std::vector<Vector3f> SmallRecording::InSubject(int frame) const {
  std::vector<Vector3f> vertices;
  SkinLinear(body.rest.vertices, body.weights, BonesAt(body.skeleton, frame), vertices);
  return vertices;
}

std::vector<Vector3f> SmallRecording::InCamera(int frame) const {
  std::vector<Vector3f> vertices = InSubject(frame);
  for (Vector3f& v : vertices) v = (camera_from_subject * v.cast<double>().eval()).cast<float>();
  return vertices;
}

std::vector<Vector3d> SmallRecording::Joints(int frame) const {
  std::vector<Vector3d> joints = PosedJoints(body.skeleton, BonesAt(body.skeleton, frame));
  for (Vector3d& joint : joints) joint = camera_from_subject * joint;
  return joints;
}

DepthImage SmallRecording::Depth(int frame) const {
  ZBuffer zbuffer(camera);
  return zbuffer.Render(InCamera(frame), body.rest.triangles);
}

SequenceInfo SmallRecording::Info() const {
  SequenceInfo info;
  info.camera = camera;
  info.depth_unit_m = depth_unit_m;
  info.frames = frames;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  return info;
}

void SmallRecording::Write(const std::filesystem::path& folder) const {
  SequenceWriter writer(folder, Info(), body, body.rest);
  for (int i = 0; i < frames; ++i) {
    const DepthImage depth = Depth(i);
    writer.Append(depth, InCamera(i), {Joints(i), VisibleJoints(Joints(i), depth, camera)});
  }
  writer.Finish();
}

}  // namespace vitruvia
