// Hypotheses for a limb that has moved away from its predicted place, for any method.
#pragma once

#include <array>
#include <vector>

#include "body/limbs.h"
#include "body/skeleton.h"
#include "body/skinning.h"
#include "config/settings.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "geometry/mesh.h"
#include "tracking/body_pose.h"

namespace vitruvia {

struct LimbSettings {
  double min_unexplained_m2 = 0.0;  // 0: limbs are not searched
  double margin = 0.01;
  int num_targets = 8, num_swivels = 12, num_refined = 2;
  void Describe(Fields& fields);
};

// The body whose limbs are searched.
struct LimbBody {
  Skeleton skeleton;
  std::array<Vector3d, kBoneCount> rest_centers;  // of BonePose, subject frame
  std::array<double, kBoneCount> radius_m;        // mean distance of skin and axis
};

// A vertex belongs to the bone of its largest weight.
LimbBody LimbBodyOf(const Skeleton& skeleton, const std::array<Vector3d, kBoneCount>& rest_centers,
                    const std::vector<Vector3f>& rest_vertices, const SkinWeights& weights);

// The pose with the limb's lower end (wrist, ankle) at `target` (camera frame), or as near to it as
// the limb reaches, bent in the direction of its hinge. `swivel_rad` turns the limb about the line
// from its root to the target.
BodyPose WithLimbAt(const LimbBody& body, const BodyPose& pose, const Limb& limb,
                    const Vector3d& target, double swivel_rad);

class LimbSearch {
 public:
  // Points are those of every `stride`-th row and column; one within `near_m` of a skin belongs to
  // it.
  LimbSearch(LimbBody body, const PinholeCamera& camera, int stride, double near_m,
             const LimbSettings& settings);

  // If `unexplained`, indices of `points` that `pose` does not explain, cover enough area:
  // hypotheses place the end of each limb on unexplained points and are scored by their bones'
  // axes. The num_refined best ones, the best one first.
  std::vector<BodyPose> Hypotheses(const DepthImage& depth, const std::vector<Vector3f>& points,
                                   const std::vector<int>& unexplained, const BodyPose& pose);

 private:
  struct Hypothesis {
    BodyPose pose;
    double score;
  };

  void CollectUnexplained(const std::vector<Vector3f>& points, const std::vector<int>& unexplained);
  double UnexplainedArea_m2() const;
  std::vector<Vector3d> SpreadTargets(const Vector3d& root) const;
  std::vector<Hypothesis> AllHypotheses(const DepthImage& depth, const BodyPose& pose) const;
  double Score(const DepthImage& depth, const BodyPose& pose, const Limb& limb) const;

  LimbBody body_;
  PinholeCamera camera_;
  int stride_;
  double near_m_;
  LimbSettings settings_;
  std::vector<Vector3d> points_;  // unexplained, camera frame
};

}  // namespace vitruvia
