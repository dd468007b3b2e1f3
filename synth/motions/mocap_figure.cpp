#include "synth/motions/mocap_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "math/angles.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using enum BoneId;

// A standing figure's limits: rest poses of real files, with legs 20° apart, keep well inside.
constexpr double kMostLeanDeg = 40.0;   // of the trunk against the legs
constexpr double kMostBendDeg = 50.0;   // of a thigh or shin against the legs
constexpr double kMostTwistDeg = 60.0;  // of the shoulders against the hips
constexpr double kLeastHips = 0.02;     // width of the hips as a share of leg length

double AngleDeg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kRadiansPerDegree;
}

double Cosine(const Vector3d& a, const Vector3d& b) {
  return a.norm() > 0.0 && b.norm() > 0.0 ? a.normalized().dot(b.normalized()) : 0.0;
}

class Figure {
 public:
  Figure(const std::vector<Vector3d>& positions, const MocapJoints& joints)
      : positions_(positions), joints_(joints) {}

  const Vector3d& At(BoneId bone) const { return positions_[joints_.At(bone)]; }
  Vector3d Along(BoneId from, BoneId to) const { return At(to) - At(from); }
  Vector3d Middle(BoneId a, BoneId b) const { return 0.5 * (At(a) + At(b)); }
  Vector3d Trunk() const { return At(kHead) - Middle(kLeftThigh, kRightThigh); }

 private:
  const std::vector<Vector3d>& positions_;
  const MocapJoints& joints_;
};

struct Segment {
  const char* name;
  BoneId from, to;
};
constexpr std::array<Segment, 4> kLegs{{{"left thigh", kLeftThigh, kLeftShin},
                                        {"left shin", kLeftShin, kLeftFoot},
                                        {"right thigh", kRightThigh, kRightShin},
                                        {"right shin", kRightShin, kRightFoot}}};
constexpr std::array<Segment, 2> kLeftArm{
    {{"left upper arm", kLeftUpperArm, kLeftForearm}, {"left forearm", kLeftForearm, kLeftHand}}};
constexpr std::array<Segment, 2> kRightArm{{{"right upper arm", kRightUpperArm, kRightForearm},
                                            {"right forearm", kRightForearm, kRightHand}}};

}  // namespace

Matrix3<double> FigureAxes::Rows() const {
  Matrix3<double> rows;
  rows << left.transpose(), up.transpose(), front.transpose();
  return rows;
}

FigureAxes AxesFrom(const Vector3d& left, const Vector3d& up) {
  const Vector3d level_left = (left - left.dot(up) * up).normalized();
  return {level_left, up, level_left.cross(up)};
}

Vector3d LegsUp(const std::vector<Vector3d>& positions, const MocapJoints& joints) {
  const Figure figure(positions, joints);
  return figure.Middle(kLeftThigh, kRightThigh) - figure.Middle(kLeftFoot, kRightFoot);
}

Vector3d HipsLeft(const std::vector<Vector3d>& positions, const MocapJoints& joints) {
  return Figure(positions, joints).Along(kRightThigh, kLeftThigh);
}

double LegLength(const std::vector<Vector3d>& positions, const MocapJoints& joints) {
  const Figure figure(positions, joints);
  return 0.5 *
         (figure.Along(kLeftThigh, kLeftShin).norm() + figure.Along(kLeftShin, kLeftFoot).norm() +
          figure.Along(kRightThigh, kRightShin).norm() +
          figure.Along(kRightShin, kRightFoot).norm());
}

std::string FigureProblem(const std::vector<Vector3d>& positions, const MocapJoints& joints) {
  const Figure figure(positions, joints);
  const double leg = LegLength(positions, joints);
  if (!(leg > 0.0)) return "the legs have no length";
  const Vector3d up = LegsUp(positions, joints);
  const double lean = AngleDeg(figure.Trunk(), up);
  if (!(lean <= kMostLeanDeg)) {
    return fmt::format(
        "from the hips, the head lies {:.0f}° away from the direction opposite to "
        "the feet; expected at most {:g}°",
        lean, kMostLeanDeg);
  }
  for (const Segment& segment : kLegs) {
    const double bend = AngleDeg(figure.Along(segment.from, segment.to), -up);
    if (bend <= kMostBendDeg) continue;
    return fmt::format(
        "the {} lies {:.0f}° away from the direction from hips to feet; expected at "
        "most {:g}°",
        segment.name, bend, kMostBendDeg);
  }
  const Vector3d up_direction = up.normalized();
  const auto level = [&](const Vector3d& v) -> Vector3d {
    return v - v.dot(up_direction) * up_direction;
  };
  const Vector3d hips = level(HipsLeft(positions, joints));
  if (!(hips.norm() > kLeastHips * leg)) return "the hips have no width";
  const double twist = AngleDeg(hips, level(figure.Along(kRightUpperArm, kLeftUpperArm)));
  if (!(twist <= kMostTwistDeg)) {
    return fmt::format(
        "the shoulders are turned by {:.0f}° against the hips; expected at most "
        "{:g}°",
        twist, kMostTwistDeg);
  }
  return "";
}

double TPoseLikeness(const std::vector<Vector3d>& positions, const MocapJoints& joints) {
  const Figure figure(positions, joints);
  const Vector3d up = LegsUp(positions, joints), left = HipsLeft(positions, joints);
  double sum = Cosine(figure.Trunk(), up);
  const auto add = [&](const auto& segments, const Vector3d& direction) {
    for (const Segment& s : segments) sum += Cosine(figure.Along(s.from, s.to), direction);
  };
  add(kLegs, -up);
  add(kLeftArm, left);
  add(kRightArm, -left);
  return sum / 9.0;
}

}  // namespace vitruvia
