// Visibility of joints in a depth camera.
#pragma once

#include <vector>

#include "geometry/camera.h"
#include "geometry/image.h"
#include "math/vector.h"

namespace vitruvia {

// A joint sits inside the body. A surface up to this distance in front of the joint counts as the
// joint's own skin; a surface farther in front hides the joint. Measured on bodies of 60 to 110 kg
// seen from all sides: the skin of a limb lies up to 0.08 m in front of its joints, that of the
// trunk up to 0.20 m.
inline constexpr double kLimbJointBelowSkinM = 0.15;
inline constexpr double kTrunkJointBelowSkinM = 0.22;  // pelvis, waist and chest

// The distance for the joint of a bone (body/skeleton.h); the limbs' value for any other number.
double JointBelowSkin(int bone);

// Whether the camera sees a joint: it projects into the image, and the depth rendered there is at
// most below_skin_m in front of it.
bool SeesJoint(const Vector3<double>& joint_in_camera, double below_skin_m, const DepthImage& depth,
               const PinholeCamera& camera);

// The same for the skeleton's joints, in the order of BoneId.
std::vector<bool> VisibleJoints(const std::vector<Vector3<double>>& joints_in_camera,
                                const DepthImage& depth, const PinholeCamera& camera);

}  // namespace vitruvia
