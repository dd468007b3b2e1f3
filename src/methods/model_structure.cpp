#include "methods/model_structure.h"

#include <algorithm>

#include "methods/dynamic/kinematic_tree.h"
#include "methods/realtime_scape/terms/main_axes.h"

namespace vitruvia {
namespace {

std::string PlaceOf(const std::string& joint, const dynamic::SkeletonFile& file) {
  return std::find_if(
             file.joints.begin(), file.joints.end(),
             [&](const dynamic::JointSettings& settings) { return settings.name == joint; })
      ->at;
}

}  // namespace

std::vector<TurningBone> BonesWithMainAxis() {
  std::vector<TurningBone> bones;
  for (const realtime_scape::MainAxis& main : realtime_scape::MainAxes())
    bones.push_back({main.bone, main.axis});
  return bones;
}

ModelSkeleton ReadModelSkeleton(const std::filesystem::path& skeleton_file,
                                const Skeleton& subject) {
  const dynamic::SkeletonFile file = dynamic::ReadSkeletonFile(skeleton_file);
  const dynamic::KinematicTree tree(file, subject);
  ModelSkeleton skeleton{file.name, {}};
  for (const dynamic::TreeJoint& joint : tree.joints()) {
    const ModelJointType type =
        joint.type == dynamic::JointType::kHinge ? ModelJointType::kHinge : ModelJointType::kSlide;
    skeleton.joints.push_back(
        {type, joint.parent, PlaceOf(joint.name, file), joint.place, joint.axis});
  }
  return skeleton;
}

}  // namespace vitruvia
