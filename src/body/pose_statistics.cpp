#include "body/pose_statistics.h"

#include <limits>

#include "math/angles.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

struct Row {
  BoneId bone;  // of the midline, or of the left
  Vector3<double> mean_deg, deviation_deg;
};

// Deviations are at least 0.1 rad (5.7 degrees), because four clips contain too little motion of
// some joints, such as the neck. The mean log density over the test clips (02_06, 02_09, 03_02,
// 11_01) is 3.4 nats for all bones together; with uniformly distributed rotations it is −70.
const std::array<Row, 10>& Rows() {
  static const std::array<Row, 10> rows{{
      {BoneId::kAbdomen, {17.2, 0.0, 0.0}, {13.4, 6.6, 5.7}},
      {BoneId::kChest, {-3.7, 0.0, 0.0}, {5.7, 5.7, 5.7}},
      {BoneId::kNeck, {-8.7, 0.0, 0.0}, {10.2, 16.9, 5.7}},
      {BoneId::kHead, {2.2, 0.0, 0.0}, {5.7, 5.7, 5.7}},
      {BoneId::kLeftUpperArm, {23.0, -21.9, -74.7}, {18.5, 18.4, 27.0}},
      {BoneId::kLeftForearm, {-2.4, -60.8, 33.5}, {7.8, 31.8, 17.2}},
      {BoneId::kLeftHand, {-3.7, -2.9, 20.8}, {8.5, 17.2, 11.3}},
      {BoneId::kLeftThigh, {-15.1, 5.1, -2.3}, {19.7, 10.1, 8.7}},
      {BoneId::kLeftShin, {34.5, 2.3, 1.4}, {21.8, 5.7, 5.7}},
      {BoneId::kLeftFoot, {-11.6, 11.5, 5.4}, {14.0, 12.9, 5.7}},
  }};
  return rows;
}

// The rotation vector of the same rotation in a mirror that exchanges left and right.
Vector3<double> Mirrored(const Vector3<double>& rotation_vector) {
  return {rotation_vector.x(), -rotation_vector.y(), -rotation_vector.z()};
}

std::array<LocalRotationStatistics, kBoneCount> MakeStatistics() {
  std::array<LocalRotationStatistics, kBoneCount> statistics;
  statistics.fill({Matrix3<double>::Identity(),
                   Vector3<double>::Constant(std::numeric_limits<double>::infinity())});
  for (const auto& [bone_id, mean_deg, deviation_deg] : Rows()) {
    const int bone = static_cast<int>(bone_id), mirror = Bones()[bone].mirror;
    const Vector3<double> deviation_rad = kRadiansPerDegree * deviation_deg;
    statistics[mirror] = {ExpSo3<double>(kRadiansPerDegree * Mirrored(mean_deg)), deviation_rad};
    statistics[bone] = {ExpSo3<double>(kRadiansPerDegree * mean_deg), deviation_rad};
  }
  return statistics;
}

}  // namespace

const std::array<LocalRotationStatistics, kBoneCount>& CapturedPoseStatistics() {
  static const std::array<LocalRotationStatistics, kBoneCount> statistics = MakeStatistics();
  return statistics;
}

}  // namespace vitruvia
