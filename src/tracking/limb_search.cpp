#include "tracking/limb_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/segment.h"

namespace vitruvia {
namespace {

constexpr int Index(BoneId id) { return static_cast<int>(id); }

Vector3d Posed(const LimbBody& body, const BodyPose& pose, int bone, const Vector3d& rest_point) {
  return pose[bone].center + pose[bone].rotation * (rest_point - body.rest_centers[bone]);
}

// A bone's axis in some pose, from its joint to its end.
Segment AxisOf(const LimbBody& body, const BodyPose& pose, BoneId bone_id) {
  const int bone = Index(bone_id);
  return {Posed(body, pose, bone, body.skeleton.joints[bone]),
          Posed(body, pose, bone, body.skeleton.tips[bone])};
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

void SetBone(const LimbBody& body, int bone, const Matrix3<double>& rotation, const Vector3d& joint,
             BodyPose& pose) {
  pose[bone].rotation = rotation;
  pose[bone].center = joint + rotation * (body.rest_centers[bone] - body.skeleton.joints[bone]);
}

}  // namespace

BodyPose WithLimbAt(const LimbBody& body, const BodyPose& pose, const Limb& limb,
                    const Vector3d& target, double swivel_rad) {
  constexpr double kStraight = 0.999;  // share of the limb's length that its ends are apart at most
  const int upper = Index(limb.upper), lower = Index(limb.lower), end = Index(limb.end);
  const auto& joints = body.skeleton.joints;
  const Vector3d upper_rest = joints[lower] - joints[upper],
                 lower_rest = joints[end] - joints[lower];
  const double upper_m = upper_rest.norm(), lower_m = lower_rest.norm();

  const Vector3d root = Posed(body, pose, Bones()[upper].parent, joints[upper]);
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
  SetBone(body, upper, Aligned(upper_rest, limb.hinge, middle - root, hinge), root, moved);
  SetBone(body, lower, Aligned(lower_rest, limb.hinge, reached - middle, hinge), middle, moved);
  SetBone(body, end, moved[lower].rotation * end_local, reached, moved);
  return moved;
}

void LimbSettings::Describe(Fields& f) {
  constexpr const char* kSource = "paper A lists recovery as future work";
  f.Number("min_unexplained_m2", min_unexplained_m2,
           {.meaning = "area of the captured surface without explanation by the model above which "
                       "limbs are searched there; 0: never",
            .unit = "m²",
            .min = 0,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = kSource});
  if (!f.Applies(min_unexplained_m2 > 0.0)) return;
  f.Number("margin", margin,
           {.meaning = "a found limb is moved only if the score rises by at least this much: in "
                       "realtime_scape the explained share of the cloud times the confirmed share "
                       "of the model, in dynamic the overlap of model and frame by area",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("num_targets", num_targets,
            {.meaning = "number of unexplained points at which the end of each limb is tried",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Integer("num_swivels", num_swivels,
            {.meaning = "number of angles about the line from a limb's root to its end at which "
                        "the limb is tried",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Integer("num_refined", num_refined,
            {.meaning = "number of best-scoring places of a limb that are refined by iterations",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = kSource});
}

LimbBody LimbBodyOf(const Skeleton& skeleton, const std::array<Vector3d, kBoneCount>& rest_centers,
                    const std::vector<Vector3f>& rest_vertices, const SkinWeights& weights) {
  LimbBody body{skeleton, rest_centers, {}};
  std::array<double, kBoneCount> count{};
  for (std::size_t i = 0; i < rest_vertices.size(); ++i) {
    const int bone = weights.bones[i][0];
    const Segment axis{skeleton.joints[bone], skeleton.tips[bone]};
    body.radius_m[bone] += axis.Distance(rest_vertices[i].cast<double>());
    ++count[bone];
  }
  for (int bone = 0; bone < kBoneCount; ++bone) body.radius_m[bone] /= std::max(count[bone], 1.0);
  return body;
}

LimbSearch::LimbSearch(LimbBody body, const PinholeCamera& camera, int stride, double near_m,
                       const LimbSettings& settings)
    : body_(std::move(body)),
      camera_(camera),
      stride_(stride),
      near_m_(near_m),
      settings_(settings) {}

std::vector<BodyPose> LimbSearch::Hypotheses(const DepthImage& depth,
                                             const std::vector<Vector3f>& points,
                                             const std::vector<int>& unexplained,
                                             const BodyPose& pose) {
  CollectUnexplained(points, unexplained);
  if (UnexplainedArea_m2() < settings_.min_unexplained_m2) return {};
  std::vector<Hypothesis> hypotheses = AllHypotheses(depth, pose);
  const auto refined = std::min(hypotheses.size(), static_cast<std::size_t>(settings_.num_refined));
  std::partial_sort(hypotheses.begin(), hypotheses.begin() + static_cast<std::ptrdiff_t>(refined),
                    hypotheses.end(),
                    [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<BodyPose> best;
  for (std::size_t k = 0; k < refined; ++k) best.push_back(hypotheses[k].pose);
  return best;
}

void LimbSearch::CollectUnexplained(const std::vector<Vector3f>& points,
                                    const std::vector<int>& unexplained) {
  points_.clear();
  for (const int i : unexplained) points_.push_back(points[i].cast<double>());
}

double LimbSearch::UnexplainedArea_m2() const {
  const double pixel_rad = stride_ / camera_.fx;
  double area_m2 = 0.0;
  for (const Vector3d& point : points_) {
    const double width_m = pixel_rad * point.z();
    area_m2 += width_m * width_m;
  }
  return area_m2;
}

// The unexplained point farthest from the limb's root, then always the one farthest from those
// already chosen.
std::vector<Vector3d> LimbSearch::SpreadTargets(const Vector3d& root) const {
  std::vector<double> distance;
  for (const Vector3d& point : points_) distance.push_back((point - root).norm());
  std::vector<Vector3d> targets;
  const auto count = std::min(points_.size(), static_cast<std::size_t>(settings_.num_targets));
  while (targets.size() < count) {
    const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
    targets.push_back(points_[static_cast<std::size_t>(farthest)]);
    for (std::size_t i = 0; i < points_.size(); ++i)
      distance[i] = std::min(distance[i], (points_[i] - targets.back()).norm());
  }
  return targets;
}

std::vector<LimbSearch::Hypothesis> LimbSearch::AllHypotheses(const DepthImage& depth,
                                                              const BodyPose& pose) const {
  std::vector<Hypothesis> hypotheses;
  for (const Limb& limb : Limbs()) {
    const int upper = Index(limb.upper), lower = Index(limb.lower), end = Index(limb.end);
    const auto& joints = body_.skeleton.joints;
    const double length_m =
        (joints[lower] - joints[upper]).norm() + (joints[end] - joints[lower]).norm();
    const Vector3d root = Posed(body_, pose, Bones()[upper].parent, joints[upper]);
    for (const Vector3d& target : SpreadTargets(root)) {
      constexpr double kBeyondReach = 1.3;  // the hand or foot is longer than the limb
      if ((target - root).norm() > kBeyondReach * length_m) continue;
      const Vector3d inside = target + body_.radius_m[lower] * target.normalized();
      for (int k = 0; k < settings_.num_swivels; ++k) {
        const double swivel_rad = 2.0 * std::numbers::pi * k / settings_.num_swivels;
        const BodyPose moved = WithLimbAt(body_, pose, limb, inside, swivel_rad);
        hypotheses.push_back({moved, Score(depth, moved, limb)});
      }
    }
  }
  return hypotheses;
}

// Share of the unexplained points that the limb's skin would explain, plus the mean over points of
// its axes: 1 where the frame shows skin in front of it, −1 where it shows free space.
double LimbSearch::Score(const DepthImage& depth, const BodyPose& pose, const Limb& limb) const {
  constexpr int kSamples = 6;  // on each axis
  constexpr double kHidden = -0.2;
  const std::array bones{limb.upper, limb.lower, limb.end};
  std::array<Segment, 3> axes;
  double support = 0.0;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    axes[b] = AxisOf(body_, pose, bones[b]);
    for (int k = 1; k <= kSamples; ++k) {
      const Vector3d point = axes[b].from + (k - 0.5) / kSamples * (axes[b].to - axes[b].from);
      const auto pixel = camera_.PixelOf(point);
      if (!pixel) continue;
      const double measured = depth(pixel->u, pixel->v);
      const double gap_m = measured - (point.z() - body_.radius_m[Index(bones[b])]);
      if (measured <= 0.0 || gap_m > near_m_) {
        support -= 1.0;
      } else {
        support += gap_m > -near_m_ ? 1.0 : kHidden;
      }
    }
  }
  int explained = 0;
  for (const Vector3d& point : points_) {
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (axes[b].Distance(point) < body_.radius_m[Index(bones[b])] + near_m_) {
        ++explained;
        break;
      }
    }
  }
  return static_cast<double>(explained) / static_cast<double>(points_.size()) +
         support / (kSamples * static_cast<double>(bones.size()));
}

}  // namespace vitruvia
