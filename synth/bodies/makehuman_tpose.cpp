#include "synth/bodies/makehuman_tpose.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

#include "core/error.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr const char* kProximal = "____head";  // suffix of a bone's joint and of its weights
constexpr const char* kDistal = "____tail";

// --- Groups of bones, by nearest listed ancestor -------------------------------------------------

struct Anchor {
  const char* bone;
  int group;
};

// For each bone of the package, the group of its nearest ancestor (or itself) among the anchors.
std::vector<int> GroupOfBone(const MakeHumanPackage& package, const std::vector<Anchor>& anchors) {
  std::vector<int> anchored(package.bones.size(), -1);
  for (const Anchor& anchor : anchors) {
    const int bone = package.FindBone(std::string(anchor.bone) + kProximal);
    if (bone < 0) {
      throw DataError(fmt::format("{}: the model beside it has no bone {}",
                                  package.target_file.string(), anchor.bone));
    }
    anchored[static_cast<std::size_t>(bone)] = anchor.group;
  }
  for (std::size_t i = 0; i < anchored.size(); ++i) {
    const int parent = package.bones[i].parent;
    if (anchored[i] < 0 && parent >= 0) anchored[i] = anchored[static_cast<std::size_t>(parent)];
  }
  return anchored;
}

SkinWeights GroupWeights(const MakeHumanPackage& package, const std::vector<Anchor>& anchors,
                         int groups) {
  const std::vector<int> group_of_bone = GroupOfBone(package, anchors);
  Eigen::MatrixXf dense = Eigen::MatrixXf::Zero(kMakeHumanBodyVertices, groups);
  for (std::size_t v = 0; v < kMakeHumanBodyVertices; ++v) {
    for (std::size_t k = 0; k < kMakeHumanInfluences; ++k) {
      const auto bone = static_cast<std::size_t>(package.skin_bones[v][k]);
      dense(static_cast<Eigen::Index>(v), group_of_bone[bone]) += package.skin_weights[v][k];
    }
  }
  return Sparsified(dense);
}

// --- The arms' way to the T-pose -----------------------------------------------------------------

// Groups of bones that move separately while the arms are raised.
enum ArmGroup { kShoulder, kUpperArm, kForearmNear, kForearmFar, kHandGroup, kArmGroups };
constexpr int kTrunk = 0;
int GroupIndex(int side, int group) { return 1 + side * kArmGroups + group; }

// Raising an arm lifts its shoulder too: by some 15° from the A-pose to the T-pose (two parts of
// arm to one of shoulder blade, Inman et al. 1944). The skeleton's chest is a single bone, so the
// shoulder remains lifted when the arms hang; a smaller value creases the neck. Tuned by eye
// between the two.
constexpr double kShoulderRiseDeg = 10.0;

// The rotation that turns direction a1 into a2, and the part of b1 across it into that of b2.
Matrix3<double> RotationOfFrames(const Vector3d& a1, const Vector3d& b1, const Vector3d& a2,
                                 const Vector3d& b2) {
  const auto frame = [](const Vector3d& a, const Vector3d& b) {
    Matrix3<double> columns;
    columns.col(0) = a.normalized();
    columns.col(1) = (b - b.dot(columns.col(0)) * columns.col(0)).normalized();
    columns.col(2) = columns.col(0).cross(columns.col(1));
    return columns;
  };
  return frame(a2, b2) * frame(a1, b1).transpose();
}

// The transform that turns by `rotation` and takes point `from` to `to`.
Rigidd Turned(const Matrix3<double>& rotation, const Vector3d& from, const Vector3d& to) {
  return {rotation, to - rotation * from};
}

struct ArmJoints {
  Vector3d collar, shoulder, elbow, wrist, index_knuckle, middle_knuckle, little_knuckle;
};

ArmJoints FindArmJoints(const MakeHumanPackage& package, const std::vector<Vector3f>& vertices,
                        const std::string& side) {
  const auto joint = [&](const char* bone) {
    return package.Joint(bone + side + kProximal, vertices);
  };
  return {joint("clavicle"),  joint("upperarm01"), joint("lowerarm01"), joint("wrist"),
          joint("finger2-1"), joint("finger3-1"),  joint("finger5-1")};
}

// posed_from_rest of each ArmGroup. `outward` is +1 for the left arm, −1 for the right.
std::array<Rigidd, kArmGroups> RaiseArm(const ArmJoints& joints, double outward) {
  const Vector3d along = outward * Vector3d::UnitX();
  const Vector3d hinge_after = -outward * Vector3d::UnitY();  // the elbow bends to the front
  const Vector3d upper = joints.elbow - joints.shoulder, fore = joints.wrist - joints.elbow;
  const Vector3d hinge = upper.cross(fore);

  std::array<Rigidd, kArmGroups> moved;
  const double rise = outward * kShoulderRiseDeg * std::numbers::pi / 180.0;
  moved[kShoulder] = RotationAbout(ExpSo3<double>(rise * Vector3d::UnitZ()), joints.collar);
  moved[kUpperArm] = Turned(RotationOfFrames(upper, hinge, along, hinge_after), joints.shoulder,
                            moved[kShoulder] * joints.shoulder);
  const Vector3d elbow = moved[kUpperArm] * joints.elbow;
  const Matrix3<double> straight = RotationOfFrames(fore, hinge, along, hinge_after);
  const Vector3d wrist = elbow + straight * fore;

  // Palm down: the knuckles run backwards from the index finger to the little one.
  const Matrix3<double> palm_down =
      RotationOfFrames(joints.middle_knuckle - joints.wrist,
                       joints.little_knuckle - joints.index_knuckle, along, -Vector3d::UnitZ());
  moved[kHandGroup] = Turned(palm_down, joints.wrist, wrist);

  // The forearm turns with the hand, more so near it: its two bones take 1/4 and 3/4 of the twist.
  const Vector3d turn = LogSo3<double>(palm_down * straight.transpose());
  const Vector3d twist = turn.dot(along) * along;
  moved[kForearmNear] = Turned(ExpSo3<double>(0.25 * twist) * straight, joints.elbow, elbow);
  moved[kForearmFar] = Turned(ExpSo3<double>(0.75 * twist) * straight, joints.elbow, elbow);
  return moved;
}

BoneTransforms RaiseArms(const MakeHumanPackage& package, const std::vector<Vector3f>& vertices) {
  BoneTransforms moved(1 + 2 * kArmGroups);
  for (int side = 0; side < 2; ++side) {
    const ArmJoints joints = FindArmJoints(package, vertices, side == 0 ? ".L" : ".R");
    const auto arm = RaiseArm(joints, side == 0 ? 1.0 : -1.0);
    for (int group = 0; group < kArmGroups; ++group) {
      moved[static_cast<std::size_t>(GroupIndex(side, group))] =
          arm[static_cast<std::size_t>(group)];
    }
  }
  return moved;
}

SkinWeights ArmWeights(const MakeHumanPackage& package) {
  static const std::vector<Anchor> kAnchors{
      {"root", kTrunk},
      {"clavicle.L", GroupIndex(0, kShoulder)},
      {"upperarm01.L", GroupIndex(0, kUpperArm)},
      {"lowerarm01.L", GroupIndex(0, kForearmNear)},
      {"lowerarm02.L", GroupIndex(0, kForearmFar)},
      {"wrist.L", GroupIndex(0, kHandGroup)},
      {"clavicle.R", GroupIndex(1, kShoulder)},
      {"upperarm01.R", GroupIndex(1, kUpperArm)},
      {"lowerarm01.R", GroupIndex(1, kForearmNear)},
      {"lowerarm02.R", GroupIndex(1, kForearmFar)},
      {"wrist.R", GroupIndex(1, kHandGroup)},
  };
  return GroupWeights(package, kAnchors, 1 + 2 * kArmGroups);
}

// --- The 17 bones --------------------------------------------------------------------------------

// A bone of ours in the package's terms.
struct BoneSource {
  BoneId bone;
  const char* root;   // takes this bone and its descendants, up to other rows' roots
  const char* joint;  // begins at this bone's proximal end …
  int joint_group;    // … which moves with this group into the T-pose
  const char* tip;    // a leaf ends at this bone's distal end (nullptr: not a leaf, or the crown)
  int tip_group;
};

// The pelvis begins at the base of the spine; the package's own root joint is the coccyx.
const std::array<BoneSource, kBoneCount>& BoneSources() {
  using enum BoneId;
  constexpr int kT = kTrunk;
  static const std::array<BoneSource, kBoneCount> kSources{{
      {kPelvis, "root", "spine05", kT, nullptr, kT},
      {kAbdomen, "spine04", "spine04", kT, nullptr, kT},
      {kChest, "spine02", "spine02", kT, nullptr, kT},
      {kNeck, "neck01", "neck01", kT, nullptr, kT},
      {kHead, "head", "head", kT, nullptr, kT},
      {kLeftUpperArm, "upperarm01.L", "upperarm01.L", GroupIndex(0, kShoulder), nullptr, kT},
      {kLeftForearm, "lowerarm01.L", "lowerarm01.L", GroupIndex(0, kUpperArm), nullptr, kT},
      {kLeftHand, "wrist.L", "wrist.L", GroupIndex(0, kForearmFar), "finger3-3.L",
       GroupIndex(0, kHandGroup)},
      {kRightUpperArm, "upperarm01.R", "upperarm01.R", GroupIndex(1, kShoulder), nullptr, kT},
      {kRightForearm, "lowerarm01.R", "lowerarm01.R", GroupIndex(1, kUpperArm), nullptr, kT},
      {kRightHand, "wrist.R", "wrist.R", GroupIndex(1, kForearmFar), "finger3-3.R",
       GroupIndex(1, kHandGroup)},
      {kLeftThigh, "upperleg01.L", "upperleg01.L", kT, nullptr, kT},
      {kLeftShin, "lowerleg01.L", "lowerleg01.L", kT, nullptr, kT},
      {kLeftFoot, "foot.L", "foot.L", kT, "toe1-2.L", kT},
      {kRightThigh, "upperleg01.R", "upperleg01.R", kT, nullptr, kT},
      {kRightShin, "lowerleg01.R", "lowerleg01.R", kT, nullptr, kT},
      {kRightFoot, "foot.R", "foot.R", kT, "toe1-2.R", kT},
  }};
  return kSources;
}

// Decimetres, in the T-pose.
Skeleton FindSkeleton(const MakeHumanPackage& package, const std::vector<Vector3f>& vertices,
                      const BoneTransforms& moved, const Vector3d& crown) {
  Skeleton skeleton;
  const auto place = [&](const char* bone, const char* end, int group) -> Vector3d {
    return moved[static_cast<std::size_t>(group)] *
           package.Joint(std::string(bone) + end, vertices);
  };
  for (const BoneSource& source : BoneSources()) {
    const auto bone = static_cast<std::size_t>(source.bone);
    skeleton.joints[bone] = place(source.joint, kProximal, source.joint_group);
    if (source.tip != nullptr) {
      skeleton.tips[bone] = place(source.tip, kDistal, source.tip_group);
    }
  }
  const auto end_at = [&](BoneId bone, BoneId child) {
    skeleton.tips[static_cast<std::size_t>(bone)] =
        skeleton.joints[static_cast<std::size_t>(child)];
  };
  using enum BoneId;
  end_at(kPelvis, kAbdomen);
  end_at(kAbdomen, kChest);
  end_at(kChest, kNeck);
  end_at(kNeck, kHead);
  skeleton.tips[static_cast<std::size_t>(kHead)] = crown;
  end_at(kLeftUpperArm, kLeftForearm);
  end_at(kLeftForearm, kLeftHand);
  end_at(kRightUpperArm, kRightForearm);
  end_at(kRightForearm, kRightHand);
  end_at(kLeftThigh, kLeftShin);
  end_at(kLeftShin, kLeftFoot);
  end_at(kRightThigh, kRightShin);
  end_at(kRightShin, kRightFoot);
  return skeleton;
}

}  // namespace

MakeHumanTPose::MakeHumanTPose(const MakeHumanPackage& package)
    : package_(package), arm_weights_(ArmWeights(package)) {}

TPosedMakeHuman MakeHumanTPose::Apply(const std::vector<Vector3f>& vertices) const {
  const BoneTransforms moved = RaiseArms(package_, vertices);
  const std::vector<Vector3f> body(vertices.begin(), vertices.begin() + kMakeHumanBodyVertices);
  TPosedMakeHuman result;
  SkinDualQuaternion(body, arm_weights_, moved, result.body_vertices);

  const auto by_height = [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); };
  const auto [lowest, highest] = std::ranges::minmax_element(result.body_vertices, by_height);
  result.skeleton = FindSkeleton(package_, vertices, moved, highest->cast<double>());

  // Feet on the floor, the pelvis above the origin.
  const Vector3d pelvis = result.skeleton.joints[static_cast<std::size_t>(BoneId::kPelvis)];
  const Vector3d origin(pelvis.x(), lowest->y(), pelvis.z());
  const auto to_subject = [&](const Vector3d& p) -> Vector3d {
    return kMetresPerDecimetre * (p - origin);
  };
  for (Vector3f& vertex : result.body_vertices) {
    vertex = to_subject(vertex.cast<double>()).cast<float>();
  }
  for (Vector3d& joint : result.skeleton.joints) joint = to_subject(joint);
  for (Vector3d& tip : result.skeleton.tips) tip = to_subject(tip);
  return result;
}

SkinWeights MergedWeights(const MakeHumanPackage& package) {
  std::vector<Anchor> anchors;
  for (const BoneSource& source : BoneSources()) {
    anchors.push_back({source.root, static_cast<int>(source.bone)});
  }
  return GroupWeights(package, anchors, kBoneCount);
}

}  // namespace vitruvia
