#include "synth/bodies/mannequin_shape.h"

#include "synth/bodies/mannequin_cage.h"
#include "synth/bodies/mannequin_limbs.h"
#include "synth/bodies/mannequin_tables.h"
#include "synth/bodies/mannequin_trunk.h"

namespace vitruvia::mannequin {
namespace {

// Joints of the spine: height over stature and z. Guessed from anatomical drawings: the hips'
// level, lumbosacral, thoracolumbar, cervicothoracic and atlanto-occipital joints, and the crown.
struct SpineJoint {
  double height, z_m;
};
constexpr SpineJoint kPelvisJoint{0.535, 0.0}, kWaistJoint{0.585, -0.015},
    kChestJoint{0.670, -0.015}, kNeckJoint{0.845, -0.030}, kHeadJoint{0.905, -0.005},
    kCrownTip{1.0, 0.0};

struct Placer {
  double stature_m;
  Vector3d operator()(const SpineJoint& joint) const {
    return {0.0, joint.height * stature_m, joint.z_m};
  }
};

class SkeletonBuilder {
 public:
  Skeleton skeleton;

  void Set(BoneId id, const Vector3d& joint, const Vector3d& tip) {
    const int bone = static_cast<int>(id), other = Bones()[bone].mirror;
    skeleton.joints[bone] = joint;
    skeleton.tips[bone] = tip;
    if (other == bone) return;
    const Vector3d mirror(-1.0, 1.0, 1.0);
    skeleton.joints[other] = joint.cwiseProduct(mirror);
    skeleton.tips[other] = tip.cwiseProduct(mirror);
  }
};

Skeleton MakeSkeleton(Sex sex, double girth_score) {
  const Placer at{Survey(sex).stature_m};
  const ArmJoints arm = LeftArmJoints(sex);
  const LegJoints leg = LeftLegJoints(sex, girth_score);
  SkeletonBuilder builder;
  builder.Set(BoneId::kPelvis, at(kPelvisJoint), at(kWaistJoint));
  builder.Set(BoneId::kAbdomen, at(kWaistJoint), at(kChestJoint));
  builder.Set(BoneId::kChest, at(kChestJoint), at(kNeckJoint));
  builder.Set(BoneId::kNeck, at(kNeckJoint), at(kHeadJoint));
  builder.Set(BoneId::kHead, at(kHeadJoint), at(kCrownTip));
  builder.Set(BoneId::kLeftUpperArm, arm.shoulder, arm.elbow);
  builder.Set(BoneId::kLeftForearm, arm.elbow, arm.wrist);
  builder.Set(BoneId::kLeftHand, arm.wrist, arm.finger_tip);
  builder.Set(BoneId::kLeftThigh, leg.hip, leg.knee);
  builder.Set(BoneId::kLeftShin, leg.knee, leg.ankle);
  builder.Set(BoneId::kLeftFoot, leg.ankle, leg.toe_tip);
  return builder.skeleton;
}

}  // namespace

Form MakeForm(Sex sex, double girth_score) {
  Form form;
  form.surface.resize(kLeftVertices, 3);
  form.surface << TrunkPoints(sex, girth_score), ArmPoints(sex, girth_score),
      LegPoints(sex, girth_score);
  form.skeleton = MakeSkeleton(sex, girth_score);
  return form;
}

}  // namespace vitruvia::mannequin
