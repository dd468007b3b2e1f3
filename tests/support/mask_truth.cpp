#include "support/mask_truth.h"

#include <algorithm>
#include <cmath>

namespace vitruvia {
namespace {

constexpr double kFootRadius_m = 0.2;  // round an ankle

}  // namespace

double MaskOverlap(const MaskImage& mask, const MaskImage& truth, const DepthImage& depth) {
  long shared = 0, either = 0;
  for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
    if (!(depth.pixels()[i] > 0.0f)) continue;
    const bool a = mask.pixels()[i] != 0, b = truth.pixels()[i] != 0;
    shared += a && b ? 1 : 0;
    either += a || b ? 1 : 0;
  }
  return static_cast<double>(shared) / static_cast<double>(either);
}

double FeetLost_px(const SequenceReader& scene, int frame, const MaskImage& mask) {
  const MaskImage truth = scene.ReadMask(frame);
  const DepthImage depth = scene.ReadDepth(frame);  // of the person
  const PinholeCamera& camera = scene.info().camera;
  const JointTruth& joints = scene.true_joints(frame);
  std::vector<Vector3d> ankles;
  for (std::size_t j = 0; j < scene.info().joints.size(); ++j) {
    if (scene.info().joints[j].ends_with("_ankle")) ankles.push_back(joints.positions[j]);
  }
  constexpr int kReach_px = 8;
  double farthest = 0.0;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0.0f) || truth(u, v) == 0 || mask(u, v) != 0) continue;
      const Vector3d point = camera.Unproject<double>(u, v, depth(u, v));
      const bool is_foot = std::any_of(ankles.begin(), ankles.end(), [&](const Vector3d& ankle) {
        return (point - ankle).norm() < kFootRadius_m;
      });
      if (!is_foot) continue;
      double nearest = kReach_px;
      for (int dv = -kReach_px; dv <= kReach_px; ++dv) {
        for (int du = -kReach_px; du <= kReach_px; ++du) {
          if (mask.Contains(u + du, v + dv) && mask(u + du, v + dv) != 0)
            nearest = std::min(nearest, std::hypot(du, dv));
        }
      }
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

}  // namespace vitruvia
