#include "methods/capsule_icp/capsule.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/error.h"

namespace vitruvia::capsule_icp {
namespace {

constexpr int kUnknowns = 8;  // both ends and both radii
constexpr double kLeastRadius_m = 0.005;

struct SkinPoint {
  Vector3d place;
  double area;
};

// Vertices that follow a bone more than all others together, with the area that each stands for.
std::vector<std::vector<SkinPoint>> SkinOfBones(const BodyModel& body) {
  std::vector<double> areas(body.rest.vertices.size(), 0.0);
  for (const Triangle& t : body.rest.triangles) {
    const Vector3f a = body.rest.vertices[t[1]] - body.rest.vertices[t[0]];
    const Vector3f b = body.rest.vertices[t[2]] - body.rest.vertices[t[0]];
    for (const std::int32_t corner : t) areas[corner] += a.cross(b).norm() / 6.0f;
  }
  std::vector<std::vector<SkinPoint>> skin(kBoneCount);
  for (std::size_t v = 0; v < areas.size(); ++v) {
    if (body.weights.weights[v][0] <= 0.5f) continue;
    skin[body.weights.bones[v][0]].push_back({body.rest.vertices[v].cast<double>(), areas[v]});
  }
  return skin;
}

bool IsTrunk(int bone) {
  return bone == static_cast<int>(BoneId::kPelvis) || bone == static_cast<int>(BoneId::kAbdomen) ||
         bone == static_cast<int>(BoneId::kChest);
}

bool HasChild(int bone) {
  return std::any_of(Bones().begin(), Bones().end(),
                     [&](const BoneInfo& other) { return other.parent == bone; });
}

// A cylinder with round ends about the mean of the points, along the bone. A limb's bone ends in
// its joints; where the surface closes, the round end does too.
Capsule FirstGuess(int bone, const Skeleton& skeleton, const std::vector<SkinPoint>& points) {
  const Vector3d direction = (skeleton.tips[bone] - skeleton.joints[bone]).normalized();
  Vector3d mean = Vector3d::Zero();
  double area = 0.0;
  for (const SkinPoint& p : points) {
    mean += p.area * p.place;
    area += p.area;
  }
  mean /= area;
  double radius = 0.0, lowest = 0.0, highest = 0.0;
  for (const SkinPoint& p : points) {
    const double along = direction.dot(p.place - mean);
    lowest = std::min(lowest, along);
    highest = std::max(highest, along);
    radius += p.area / area * (p.place - mean - along * direction).norm();
  }
  const bool is_limb = !IsTrunk(bone) && HasChild(bone);
  const double inset = is_limb ? 0.0 : radius;
  const double middle = 0.5 * (lowest + highest);
  const double half = std::max(0.5 * (highest - lowest) - inset, kLeastRadius_m);
  return {bone, mean + (middle - half) * direction, mean + (middle + half) * direction, radius,
          radius};
}

using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

Unknowns UnknownsOf(const Capsule& c) {
  Unknowns x;
  x << c.start, c.end, c.start_radius_m, c.end_radius_m;
  return x;
}

Capsule CapsuleOf(int bone, const Unknowns& x) {
  return {bone, x.head<3>(), x.segment<3>(3), std::max(x[6], kLeastRadius_m),
          std::max(x[7], kLeastRadius_m)};
}

// Gauss–Newton on the squared distances, with a weak prior on the first guess for parameters that
// no vertex determines, such as the ends of a limb. Because the distance is a minimum over t, the
// derivative treats t as fixed.
Capsule Fitted(const Capsule& guess, const std::vector<SkinPoint>& points) {
  constexpr int kIterations = 20;
  constexpr double kHold = 0.02;  // of the points' weight
  const Unknowns start = UnknownsOf(guess);
  Capsule capsule = guess;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
    normal.setZero();
    Unknowns right = Unknowns::Zero();
    double area = 0.0;
    for (const SkinPoint& p : points) {
      const CapsuleDistance d = DistanceFrom(capsule, p.place);
      Unknowns row;
      row << -(1.0 - d.t) * d.normal, -d.t * d.normal, -(1.0 - d.t), -d.t;
      normal += p.area * row * row.transpose();
      right -= p.area * d.distance_m * row;
      area += p.area;
    }
    const Unknowns x = UnknownsOf(capsule);
    normal.diagonal().array() += kHold * area;
    right += kHold * area * (start - x);
    capsule = CapsuleOf(guess.bone, x + normal.ldlt().solve(right));
  }
  return capsule;
}

// Side by side along x, each with the points that are nearest to it.
std::vector<Capsule> FitSideBySide(int bone, const Skeleton& skeleton,
                                   std::vector<SkinPoint> points, int count) {
  constexpr int kRounds = 6;
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::vector<SkinPoint>> shares(n);
  const auto [left, right] = std::minmax_element(
      points.begin(), points.end(),
      [](const SkinPoint& a, const SkinPoint& b) { return a.place.x() < b.place.x(); });
  const double from = left->place.x(), width = right->place.x() - from;
  for (const SkinPoint& p : points) {
    const double share = (p.place.x() - from) / width;
    shares[std::min(static_cast<std::size_t>(share * count), n - 1)].push_back(p);
  }
  std::vector<Capsule> capsules(n);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < n; ++k) {
      if (round == 0) capsules[k] = FirstGuess(bone, skeleton, shares[k]);
      if (!shares[k].empty()) capsules[k] = Fitted(capsules[k], shares[k]);
    }
    for (auto& share : shares) share.clear();
    for (const SkinPoint& p : points) {
      const auto nearest = std::min_element(
          capsules.begin(), capsules.end(), [&](const Capsule& a, const Capsule& b) {
            return DistanceFrom(a, p.place).distance_m < DistanceFrom(b, p.place).distance_m;
          });
      shares[static_cast<std::size_t>(nearest - capsules.begin())].push_back(p);
    }
  }
  return capsules;
}

}  // namespace

// Along the segment, sqrt((y − z)² + h²) − r(z) is least at z = y − h tan φ, sin φ the taper.
CapsuleDistance DistanceFrom(const Capsule& capsule, const Vector3d& x) {
  constexpr double kSteepest = 0.99;  // sin φ; beyond, one sphere holds the other
  const Vector3d segment = capsule.end - capsule.start;
  const double length = std::max(segment.norm(), 1e-9);
  const Vector3d axis = segment / length, from_start = x - capsule.start;
  const double sine =
      std::clamp((capsule.start_radius_m - capsule.end_radius_m) / length, -kSteepest, kSteepest);
  const double along = axis.dot(from_start);
  const double across = std::sqrt(std::max(from_start.squaredNorm() - along * along, 0.0));
  const double z = std::clamp(along - across * sine / std::sqrt(1.0 - sine * sine), 0.0, length);
  const Vector3d away = from_start - z * axis;
  const double distance = away.norm();
  CapsuleDistance result;
  result.t = z / length;
  result.distance_m = distance - capsule.start_radius_m +
                      result.t * (capsule.start_radius_m - capsule.end_radius_m);
  result.normal = distance > 0.0 ? Vector3d(away / distance) : axis.unitOrthogonal();
  return result;
}

std::vector<Capsule> FitCapsules(const BodyModel& body, int trunk_capsules) {
  constexpr std::size_t kLeastPoints = 4;
  const std::vector<std::vector<SkinPoint>> skin = SkinOfBones(body);
  std::vector<Capsule> capsules;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (skin[bone].size() < kLeastPoints) continue;
    const std::vector<Capsule> of_bone =
        FitSideBySide(bone, body.skeleton, skin[bone], IsTrunk(bone) ? trunk_capsules : 1);
    capsules.insert(capsules.end(), of_bone.begin(), of_bone.end());
  }
  if (capsules.empty()) {
    throw DataError(
        fmt::format("{}: no bone carries {} vertices by more than half, which a capsule is fitted "
                    "to; are the weights those of the mesh?",
                    body.name, kLeastPoints));
  }
  return capsules;
}

}  // namespace vitruvia::capsule_icp
