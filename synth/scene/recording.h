// The recording of a scene whose bodies and motion are already there.
#pragma once

#include <filesystem>

#include "synth/scene/scene.h"

namespace vitruvia {

// Moves `truth`, renders and measures it as `settings` say, and writes the sequence. `subject` is
// the template that goes with it. Settings of the body, the motion and the refinements are only
// noted in the provenance.
void RecordSequence(const SceneSettings& settings, const BodyModel& truth, const BodyModel& subject,
                    const Motion& motion, const std::filesystem::path& folder);

// The body's surface and joints in the camera frame, and the motion that brought them there.
struct PosedBody {
  std::vector<Vector3f> vertices;
  std::vector<Vector3<double>> joints;
  BoneTransforms camera_from_rest;
};
PosedBody Pose(const BodyModel& body, const MotionSample& sample, Skinning skinning,
               const Rigidd& camera_from_subject);

// A joint sits inside the body. Skin up to this much nearer to the camera than the joint counts as
// the joint's own; anything nearer than that hides it. Measured on bodies of 60 to 110 kg seen from
// all sides: a limb's own skin lies up to 0.08 m before its joints, a trunk's up to 0.20 m.
inline constexpr double kLimbJointBelowSkinM = 0.15;
inline constexpr double kTrunkJointBelowSkinM = 0.22;  // pelvis, waist and chest

// The one of the two for the joint of a bone (body/skeleton.h); a limb's for any other number.
double JointBelowSkin(int bone);

// Whether the camera sees a joint: it projects into the image, and the depth rendered there is at
// most below_skin_m in front of it.
bool SeesJoint(const Vector3<double>& joint_in_camera, double below_skin_m, const DepthImage& depth,
               const PinholeCamera& camera);

// The same for the skeleton's joints, in the order of BoneId.
std::vector<bool> VisibleJoints(const std::vector<Vector3<double>>& joints_in_camera,
                                const DepthImage& depth, const PinholeCamera& camera);

}  // namespace vitruvia
