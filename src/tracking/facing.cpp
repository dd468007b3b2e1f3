#include "tracking/facing.h"

#include <algorithm>

namespace vitruvia {
namespace {

const Vector3<double> kHalfTurnAboutY(-1.0, 1.0, -1.0);

}  // namespace

void FacingSettings::Describe(Fields& f) {
  f.Number(
      "margin_m", margin_m,
      {.meaning = "the pose with front and back exchanged is tried when the root mean square "
                  "of the differences in depth between model and frame exceeds the usual one "
                  "by this in square, and is taken if it is lower by as much; a trial without "
                  "success raises the usual one by as much; 0: never",
       .unit = "m",
       .min = 0,
       .max = 1,
       .origin = Origin::kTuned,
       .source = "half_turn of stability/realtime_scape; of 180 frames of fig14's S1, 41 are tried "
                 "without success with 6 mm and 2 with 10 mm"});
  if (!f.Applies(margin_m > 0.0)) return;
  f.Number("least_decrease", least_decrease,
           {.meaning = "share by which the exchanged pose must lower the mean square of these "
                       "differences too: noise of some centimetres makes them vary by more than "
                       "margin_m",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "half_turn of stability/realtime_scape, noise and few_pairs of causes"});
  f.Integer("pause", pause,
            {.meaning = "least number of frames between two such trials; doubled by each trial "
                        "that finds nothing",
             .unit = "frames",
             .min = 1,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = "as recovery.pause"});
}

BoneTransforms FacingAway(const Skeleton& skeleton, const BoneTransforms& camera_from_rest) {
  BoneTransforms away(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int mirror = Bones()[bone].mirror;
    const Matrix3<double> turn = kHalfTurnAboutY.asDiagonal();
    const Rigidd mirror_from_bone{turn, skeleton.joints[mirror] - turn * skeleton.joints[bone]};
    away[bone] = camera_from_rest[mirror] * mirror_from_bone;
  }
  return away;
}

Rigidd HalfTurn(const Matrix3<double>& camera_from_rest, const Vector3<double>& center) {
  const Matrix3<double> turn =
      camera_from_rest * kHalfTurnAboutY.asDiagonal() * camera_from_rest.transpose();
  return RotationAbout<double>(turn, center);
}

bool FacingWatch::IsDue(double gap_m2) {
  constexpr double kFollow = 0.05;  // share of a new gap in the usual one
  if (usual_m2_ < 0.0) usual_m2_ = gap_m2;
  pause_.NextFrame();
  if (gap_m2 <= usual_m2_ + margin_m2()) {
    usual_m2_ += kFollow * (gap_m2 - usual_m2_);
    pause_.Reset();
    return false;
  }
  if (!pause_.is_over()) return false;
  pause_.Begin();
  return true;
}

void FacingWatch::NoteTrial(bool found) {
  if (found) {
    pause_.Reset();
  } else {
    usual_m2_ += margin_m2();
  }
}

double FacingWatch::GapToBeat(double current_m2) const {
  return std::min(current_m2 - margin_m2(), (1.0 - settings_.least_decrease) * current_m2);
}

}  // namespace vitruvia
