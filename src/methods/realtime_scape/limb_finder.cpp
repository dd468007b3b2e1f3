#include "methods/realtime_scape/limb_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitruvia::realtime_scape {
namespace {

constexpr int Index(BoneId id) { return static_cast<int>(id); }

// A bone's axis in some pose, from its joint to its end.
struct Segment {
  Vector3d from, to;

  double Distance(const Vector3d& point) const {
    const Vector3d along = to - from;
    const double share =
        std::clamp((point - from).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
    return (point - from - share * along).norm();
  }
};

Vector3d Posed(const Model& model, const BodyPose& pose, int bone, const Vector3d& rest_point) {
  return pose[bone].center + pose[bone].rotation * (rest_point - model.rest_centers[bone]);
}

Segment AxisOf(const Model& model, const BodyPose& pose, BoneId bone_id) {
  const int bone = Index(bone_id);
  return {Posed(model, pose, bone, model.skeleton.joints[bone]),
          Posed(model, pose, bone, model.skeleton.tips[bone])};
}

// The rotation that maps the rest pose's `along` to `to` and its `hinge` as closely as possible to
// `hinge_to`.
Matrix3<double> Aligned(const Vector3d& along, const Vector3d& hinge, const Vector3d& to,
                        const Vector3d& hinge_to) {
  const auto frame = [](const Vector3d& first, const Vector3d& second) {
    Matrix3<double> axes;
    axes.col(0) = first.normalized();
    axes.col(2) = first.cross(second).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  };
  return frame(to, hinge_to) * frame(along, hinge).transpose();
}

void SetBone(const Model& model, int bone, const Matrix3<double>& rotation, const Vector3d& joint,
             BodyPose& pose) {
  pose[bone].rotation = rotation;
  pose[bone].center = joint + rotation * (model.rest_centers[bone] - model.skeleton.joints[bone]);
}

}  // namespace

const std::array<Limb, 4>& Limbs() {
  using enum BoneId;
  static const std::array<Limb, 4> limbs{{
      {kLeftUpperArm, kLeftForearm, kLeftHand, -Vector3d::UnitY()},
      {kRightUpperArm, kRightForearm, kRightHand, Vector3d::UnitY()},
      {kLeftThigh, kLeftShin, kLeftFoot, Vector3d::UnitX()},
      {kRightThigh, kRightShin, kRightFoot, Vector3d::UnitX()},
  }};
  return limbs;
}

BodyPose WithLimbAt(const Model& model, const BodyPose& pose, const Limb& limb,
                    const Vector3d& target, double swivel_rad) {
  constexpr double kStraight = 0.999;  // share of the limb's length that its ends are apart at most
  const int upper = Index(limb.upper), lower = Index(limb.lower), end = Index(limb.end);
  const auto& joints = model.skeleton.joints;
  const Vector3d upper_rest = joints[lower] - joints[upper],
                 lower_rest = joints[end] - joints[lower];
  const double upper_m = upper_rest.norm(), lower_m = lower_rest.norm();

  const Vector3d root = Posed(model, pose, Bones()[upper].parent, joints[upper]);
  const Vector3d to_target = target - root;
  const double apart_m =
      std::clamp(to_target.norm(), std::abs(upper_m - lower_m) / kStraight + 1e-6,
                 kStraight * (upper_m + lower_m));
  const Vector3d line = to_target.normalized();
  const Vector3d side = line.unitOrthogonal();
  const Vector3d swivel = std::cos(swivel_rad) * side + std::sin(swivel_rad) * line.cross(side);
  // The middle joint, in the triangle of both bones and the line.
  const double along_m =
      (upper_m * upper_m - lower_m * lower_m + apart_m * apart_m) / (2.0 * apart_m);
  const double off_m = std::sqrt(std::max(upper_m * upper_m - along_m * along_m, 0.0));
  const Vector3d middle = root + along_m * line + off_m * swivel;
  const Vector3d reached = root + apart_m * line;
  const Vector3d hinge = swivel.cross(line);  // from the upper bone to the lower one

  BodyPose moved = pose;
  const Matrix3<double> end_local = RelativeRotation(pose[lower].rotation, pose[end].rotation);
  SetBone(model, upper, Aligned(upper_rest, limb.hinge, middle - root, hinge), root, moved);
  SetBone(model, lower, Aligned(lower_rest, limb.hinge, reached - middle, hinge), middle, moved);
  SetBone(model, end, moved[lower].rotation * end_local, reached, moved);
  return moved;
}

LimbFinder::LimbFinder(const Model& model, const PinholeCamera& camera, const Settings& settings)
    : model_(model), camera_(camera), settings_(settings), fitter_(model, camera, settings) {
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const Segment axis{model.skeleton.joints[bone], model.skeleton.tips[bone]};
    double sum_m = 0.0;
    for (const int i : model.vertices_of_bone[bone])
      sum_m += axis.Distance(model.rest_vertices[i].cast<double>());
    radius_m_[bone] =
        sum_m / static_cast<double>(std::max<std::size_t>(model.vertices_of_bone[bone].size(), 1));
  }
}

std::optional<FitSummary> LimbFinder::Search(const Observation& observation,
                                             const FitSummary& current,
                                             const std::vector<int>& unexplained) {
  CollectUnexplained(observation, unexplained);
  if (UnexplainedArea_m2() < settings_.limbs.min_unexplained_m2) return {};
  const PoseCheck now = fitter_.Compare(observation, current.pose);
  std::vector<Hypothesis> hypotheses = Hypotheses(observation, current.pose);
  const auto refined =
      std::min(hypotheses.size(), static_cast<std::size_t>(settings_.limbs.num_refined));
  std::partial_sort(hypotheses.begin(), hypotheses.begin() + static_cast<std::ptrdiff_t>(refined),
                    hypotheses.end(),
                    [](const auto& a, const auto& b) { return a.score > b.score; });

  std::optional<FitSummary> best;
  Agreement best_agreement = now.agreement;
  for (std::size_t k = 0; k < refined; ++k) {
    FitSummary fit =
        fitter_.Refine(observation, hypotheses[k].pose, settings_.stopping.max_iterations);
    if (!fit.solved || fit.agreement.score() < best_agreement.score() + settings_.limbs.margin)
      continue;
    best_agreement = fit.agreement;
    best = std::move(fit);
  }
  return best;
}

void LimbFinder::CollectUnexplained(const Observation& observation,
                                    const std::vector<int>& unexplained) {
  points_.clear();
  for (const int i : unexplained) points_.push_back(observation.cloud.points[i].cast<double>());
}

double LimbFinder::UnexplainedArea_m2() const {
  const double pixel_rad = settings_.cloud.stride / camera_.fx;
  double area_m2 = 0.0;
  for (const Vector3d& point : points_) {
    const double width_m = pixel_rad * point.z();
    area_m2 += width_m * width_m;
  }
  return area_m2;
}

// The unexplained point farthest from the limb's root, then always the one farthest from those
// already chosen.
std::vector<Vector3d> LimbFinder::SpreadTargets(const Vector3d& root) const {
  std::vector<double> distance;
  for (const Vector3d& point : points_) distance.push_back((point - root).norm());
  std::vector<Vector3d> targets;
  const auto count =
      std::min(points_.size(), static_cast<std::size_t>(settings_.limbs.num_targets));
  while (targets.size() < count) {
    const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
    targets.push_back(points_[static_cast<std::size_t>(farthest)]);
    for (std::size_t i = 0; i < points_.size(); ++i)
      distance[i] = std::min(distance[i], (points_[i] - targets.back()).norm());
  }
  return targets;
}

std::vector<LimbFinder::Hypothesis> LimbFinder::Hypotheses(const Observation& observation,
                                                           const BodyPose& pose) const {
  std::vector<Hypothesis> hypotheses;
  for (const Limb& limb : Limbs()) {
    const int upper = Index(limb.upper), lower = Index(limb.lower), end = Index(limb.end);
    const auto& joints = model_.skeleton.joints;
    const double length_m =
        (joints[lower] - joints[upper]).norm() + (joints[end] - joints[lower]).norm();
    const Vector3d root = Posed(model_, pose, Bones()[upper].parent, joints[upper]);
    for (const Vector3d& target : SpreadTargets(root)) {
      constexpr double kBeyondReach = 1.3;  // the hand or foot is longer than the limb
      if ((target - root).norm() > kBeyondReach * length_m) continue;
      const Vector3d inside = target + radius_m_[lower] * target.normalized();
      for (int k = 0; k < settings_.limbs.num_swivels; ++k) {
        const double swivel_rad = 2.0 * std::numbers::pi * k / settings_.limbs.num_swivels;
        const BodyPose moved = WithLimbAt(model_, pose, limb, inside, swivel_rad);
        hypotheses.push_back({moved, Score(observation, moved, limb)});
      }
    }
  }
  return hypotheses;
}

// Share of the unexplained points that the limb's skin would explain, plus the mean over points of
// its axes: 1 where the frame shows skin in front of it, −1 where it shows free space.
double LimbFinder::Score(const Observation& observation, const BodyPose& pose,
                         const Limb& limb) const {
  constexpr int kSamples = 6;  // on each axis
  constexpr double kHidden = -0.2;
  const double near_m = settings_.fit.near_surface_m;
  const std::array bones{limb.upper, limb.lower, limb.end};
  std::array<Segment, 3> axes;
  double support = 0.0;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    axes[b] = AxisOf(model_, pose, bones[b]);
    for (int k = 1; k <= kSamples; ++k) {
      const Vector3d point = axes[b].from + (k - 0.5) / kSamples * (axes[b].to - axes[b].from);
      const auto pixel = camera_.PixelOf(point);
      if (!pixel) continue;
      const double measured = (*observation.depth)(pixel->u, pixel->v);
      const double gap_m = measured - (point.z() - radius_m_[Index(bones[b])]);
      if (measured <= 0.0 || gap_m > near_m) {
        support -= 1.0;
      } else {
        support += gap_m > -near_m ? 1.0 : kHidden;
      }
    }
  }
  int explained = 0;
  for (const Vector3d& point : points_) {
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (axes[b].Distance(point) < radius_m_[Index(bones[b])] + near_m) {
        ++explained;
        break;
      }
    }
  }
  return static_cast<double>(explained) / static_cast<double>(points_.size()) +
         support / (kSamples * static_cast<double>(bones.size()));
}

}  // namespace vitruvia::realtime_scape
