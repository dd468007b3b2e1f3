#include "methods/realtime_scape/recovery.h"

#include <algorithm>
#include <numbers>

#include "methods/realtime_scape/terms/inertia_term.h"

namespace vitruvia::realtime_scape {
namespace {

constexpr int kHeadings = 8;
constexpr double kUsualFollows = 0.05;  // share of a new agreement in the usual one

double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Mean angle between the bones' local rotations.
double MeanTurn(const BodyPose& a, const BodyPose& b) {
  const LocalRotations from = LocalRotationsOf(a), to = LocalRotationsOf(b);
  double sum_rad = 0.0;
  for (int j = 0; j < kBoneCount; ++j) {
    sum_rad += LogSo3<double>(from[j].transpose() * to[j]).norm();
  }
  return sum_rad / kBoneCount;
}

// The whole body turned about its root's centre.
BodyPose TurnedAbout(const BodyPose& pose, const Matrix3<double>& turn) {
  const Vector3d pivot = pose.front().center;
  BodyPose turned = pose;
  for (BonePose& bone : turned) {
    bone.rotation = turn * bone.rotation;
    bone.center = pivot + turn * (bone.center - pivot);
  }
  return turned;
}

}  // namespace

double Agreement::presence() const {
  constexpr double kEnoughJudged = 0.1;
  return judged >= kEnoughJudged ? confirmed : explained;
}

Agreement MeasureAgreement(std::size_t points, std::size_t unexplained, std::size_t visible,
                           const VertexClasses& classes) {
  const std::size_t confirmed = classes.near_surface.size();
  const std::size_t judged = confirmed + classes.elsewhere.size();
  return {Share(points - unexplained, points), Share(confirmed, judged), Share(judged, visible)};
}

// Low is a model of which too little is confirmed, or one that leaves much unexplained while it
// does not fit itself. What stands before the body leaves much unexplained too, but the model fits.
bool Recovery::IsLow(const Agreement& agreement) const {
  constexpr double kFits = 0.97;  // of the usual share
  return agreement.presence() < settings_.below * usual_.presence() ||
         (agreement.score() < settings_.below * usual_.score() &&
          agreement.confirmed < kFits * usual_.confirmed);
}

bool Recovery::Note(const Agreement& agreement, const BodyPose& pose) {
  const bool is_low = IsLow(agreement);
  if (is_first_) {
    is_first_ = false;
    remembered_.push_back(pose);
    usual_ = agreement;
    return is_low && settings_.patience > 0;  // there is nothing better to wait for
  }
  if (!is_low) {
    usual_.explained += kUsualFollows * (agreement.explained - usual_.explained);
    usual_.confirmed += kUsualFollows * (agreement.confirmed - usual_.confirmed);
    usual_.judged += kUsualFollows * (agreement.judged - usual_.judged);
    misses_ = 0;
    Remember(pose);
    return false;
  }
  ++misses_;
  if (settings_.patience == 0 || misses_ < settings_.patience || pause_ > 0) {
    pause_ = std::max(pause_ - 1, 0);
    return false;
  }
  pause_ = settings_.pause - 1;
  return true;
}

bool Recovery::IsBetter(const Agreement& other, const Agreement& current) const {
  return other.score() > current.score() + settings_.margin && other.confirmed >= current.confirmed;
}

void Recovery::Found(const Agreement& agreement) {
  misses_ = 0;
  if (agreement.score() > usual_.score()) usual_ = agreement;
}

void Recovery::Remember(const BodyPose& pose) {
  const double apart_rad = settings_.apart_deg * std::numbers::pi / 180.0;
  const bool is_new =
      std::all_of(remembered_.begin(), remembered_.end(),
                  [&](const BodyPose& other) { return MeanTurn(pose, other) >= apart_rad; });
  if (!is_new) return;
  if (remembered_.size() < static_cast<std::size_t>(settings_.remembered)) {
    remembered_.push_back(pose);
    return;
  }
  if (remembered_.size() < 2) return;
  remembered_[next_] = pose;
  next_ = next_ + 1 < remembered_.size() ? next_ + 1 : 1;
}

std::vector<BodyPose> Recovery::Hypotheses(const BodyPose& latest) const {
  const Matrix3<double> upside_down = Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  std::vector<BodyPose> poses = remembered_;
  poses.push_back(latest);
  std::vector<BodyPose> hypotheses;
  for (const BodyPose& pose : poses) {
    for (int k = 0; k < kHeadings; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kHeadings;
      const Matrix3<double> heading = ExpSo3<double>({0.0, angle, 0.0});
      hypotheses.push_back(TurnedAbout(pose, heading));
      hypotheses.push_back(TurnedAbout(pose, upside_down * heading));
    }
  }
  return hypotheses;
}

BodyPose Shifted(BodyPose pose, const Vector3<double>& shift) {
  for (BonePose& bone : pose) bone.center += shift;
  return pose;
}

}  // namespace vitruvia::realtime_scape
