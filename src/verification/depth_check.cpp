#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/point_cloud.h"
#include "geometry/zbuffer.h"
#include "math/statistics.h"
#include "sequence/sequence_files.h"
#include "verification/checks.h"
#include "verification/depth_agreement.h"
#include "verification/depth_cause.h"
#include "verification/depth_changes.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

// Ways to mirror or turn an image that leave a standing person much of the same pixels.
struct ImageTurn {
  const char* text;
  DepthImage (*turned)(const DepthImage& depth);
};
constexpr std::array<ImageTurn, 3> kImageTurns{
    {{"mirrored left to right", MirroredSideways},
     {"upside down, their rows in reverse", TurnedUpsideDown},
     {"turned by 180 degrees", TurnedHalfRound}}};

// All that frames say together of depth and true surface.
struct SurfaceComparison {
  DepthAgreement sum;
  std::array<MirrorVotes, kImageTurns.size()> votes;
  std::vector<double> scales_u, scales_v, edges_u_px, edges_v_px, shifts_u_px,
      shifts_v_px;  // of frames with like outlines
  std::optional<Finding> frame_problem;
};

// One frame alone is in another unit although its outline is the surface's.
std::optional<Finding> FrameProblem(const DepthAgreement& a, int frame, double unit_m) {
  const double ratio = a.DepthRatio();
  if (a.both < kFewPixels || a.AgreeingShare() >= kFrameAgreeingShare ||
      a.Silhouette() < kFrameSilhouette || std::max(ratio, 1.0 / ratio) < kFrameRatio)
    return std::nullopt;
  return Impossible(
      "depth/{}: the depth of this frame is {}: {:.4g} times that of the true surface in the "
      "median of {} pixels; {}",
      SequenceFiles::FrameName(frame), TimesTooLarge(ratio), ratio, a.both,
      DepthUnitCause(ratio, unit_m));
}

SurfaceComparison CompareWithSurface(const SequenceReader& sequence,
                                     const std::vector<int>& frames) {
  SurfaceComparison all;
  ZBuffer zbuffer(sequence.info().camera);
  for (const int frame : frames) {
    const DepthImage measured = sequence.ReadDepth(frame);
    const DepthImage& rendered =
        zbuffer.Render(sequence.ReadTrueVertices(frame), sequence.true_rest_mesh().triangles);
    const DepthAgreement a = Compare(measured, rendered);
    if (a.measured == 0) continue;  // a lost frame
    Add(a, all.sum);
    for (std::size_t k = 0; k < kImageTurns.size(); ++k)
      Vote(measured, rendered, kImageTurns[k].turned(rendered), all.votes[k]);
    if (!all.frame_problem)
      all.frame_problem = FrameProblem(a, frame, sequence.info().depth_unit_m);
    if (a.both < kFewPixels || a.Silhouette() < kFrameSilhouette) continue;
    const OutlineDifference outline = CompareOutlines(measured, rendered);
    all.scales_u.push_back(outline.scale_u);
    all.scales_v.push_back(outline.scale_v);
    all.edges_u_px.push_back(outline.edges_u_px);
    all.edges_v_px.push_back(outline.edges_v_px);
    all.shifts_u_px.push_back(outline.shift_u_px);
    all.shifts_v_px.push_back(outline.shift_v_px);
  }
  return all;
}

// The turn with the most votes, if these are enough.
std::optional<Finding> TurnProblem(const std::array<MirrorVotes, kImageTurns.size()>& votes) {
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
    return a.for_mirror - a.for_truth < b.for_mirror - b.for_truth;
  });
  const bool is_clear =
      most->for_mirror > kMirrorFewestVotes &&
      static_cast<double>(most->for_mirror) > kMirrorVotes * static_cast<double>(most->for_truth);
  if (!is_clear) return std::nullopt;
  return Impossible(
      "depth/: the images look {}: where the true surface and its image changed so differ, {} "
      "pixels have the surface's depth and {} the changed image's",
      kImageTurns[static_cast<std::size_t>(most - votes.begin())].text, most->for_truth,
      most->for_mirror);
}

// What is slightly off although depth and surface agree on the whole.
void WarnOfSlightDifferences(const SequenceInfo& info, const SurfaceComparison& all,
                             Findings& findings) {
  const double ratio = all.sum.DepthRatio();
  if (std::abs(ratio - 1.0) > kDepthRatioWarning)
    findings.push_back(
        Warning("depth/: the depth is {:.3g} times that of the true surface in the median of {} "
                "pixels; {}",
                ratio, all.sum.both, DepthUnitCause(ratio, info.depth_unit_m)));
  if (all.scales_u.empty()) return;
  const double scale_u = Quantile(all.scales_u, 0.5), scale_v = Quantile(all.scales_v, 0.5);
  const auto is_scaled = [](double scale, const std::vector<double>& edges_px) {
    return std::abs(scale - 1.0) > kOutlineScaleWarning &&
           Quantile(edges_px, 0.5) > kOutlineEdgeWarning_px;
  };
  if (is_scaled(scale_u, all.edges_u_px) || is_scaled(scale_v, all.edges_v_px))
    findings.push_back(
        Warning("sequence.json: camera: the person's outline in depth/ is {:.3f} times as wide and "
                "{:.3f} times as high as the true surface's; is fx {:.4g} and fy {:.4g} meant "
                "instead of {:g} and {:g}?",
                scale_u, scale_v, scale_u * info.camera.fx, scale_v * info.camera.fy,
                info.camera.fx, info.camera.fy));
  const double shift_u = Quantile(all.shifts_u_px, 0.5), shift_v = Quantile(all.shifts_v_px, 0.5);
  if (std::max(std::abs(shift_u), std::abs(shift_v)) > kOutlineShiftWarning * info.camera.width)
    findings.push_back(
        Warning("sequence.json: camera: the person's outline in depth/ is ({:.1f}, {:.1f}) pixels "
                "away from the true surface's; is cx {:.4g} and cy {:.4g} meant instead of {:g} "
                "and {:g}?",
                shift_u, shift_v, info.camera.cx + shift_u, info.camera.cy + shift_v,
                info.camera.cx, info.camera.cy));
}

Findings CheckAgainstSurface(const SequenceReader& sequence, const std::vector<int>& frames) {
  const SurfaceComparison all = CompareWithSurface(sequence, frames);
  const DepthAgreement& sum = all.sum;
  if (sum.measured < kFewPixels) return {};
  const std::string evidence = fmt::format(
      "{} pixels of {} frames show the true surface, {} of them have depth, {} agree within {:g} m",
      sum.rendered, frames.size(), sum.both, sum.agreeing, kAgreeWithin_m);
  const bool is_elsewhere =
      sum.CoveredShare() < kCoveredShare &&
      static_cast<double>(sum.both) < kCoveredShare * static_cast<double>(sum.measured);
  if (sum.both < kFewPixels || is_elsewhere || sum.AgreeingShare() < kAgreeingShare)
    return {Impossible("depth/: depth and true surface disagree: {}: {}", evidence,
                       CauseOfDisagreement(sequence, sum))};
  if (const auto problem = TurnProblem(all.votes)) return {*problem};
  if (all.frame_problem) return {*all.frame_problem};
  Findings findings;
  if (sum.CoveredShare() < kCoveredShare)
    findings.push_back(
        Warning("depth/: most of the person has no depth: {}; does the mask, or "
                "65535 × depth_unit_m, leave it out?",
                evidence));
  WarnOfSlightDifferences(sequence.info(), all, findings);
  return findings;
}

Findings CheckAgainstJoints(const SequenceReader& sequence, const std::vector<int>& frames) {
  const JointAgreement sum = CompareWithJoints(sequence, frames);
  if (sum.seen < kFewestJoints) return {};
  const std::string evidence = fmt::format(
      "{} joints of {} frames are marked visible, {} of them project onto measured depth, {} lie "
      "behind it by {:g} to {:g} m",
      sum.visible, frames.size(), sum.seen, sum.agreeing, -kDepthBehindJoint_m,
      kJointBehindDepth_m);
  if (sum.agreeing < kAgreeingShare * sum.seen || sum.seen < kCoveredShare * sum.visible)
    return {Impossible("depth/: depth and true joints disagree: {}: {}", evidence,
                       CauseOfDisagreement(sequence, sum))};
  return {};
}

// Height of what an image shows, from the 2nd to the 98th percentile of its points.
double ApparentHeight(const DepthImage& depth, const PinholeCamera& camera) {
  PointCloud cloud;
  CloudFromDepth(depth, camera, 2, std::numeric_limits<float>::infinity(), cloud);
  if (cloud.points.size() < static_cast<std::size_t>(kFewPixels)) return 0.0;
  std::vector<double> heights;
  for (const Vector3f& p : cloud.points) heights.push_back(p.y());
  return Quantile(heights, 0.98) - Quantile(heights, 0.02);
}

// Without any truth: the first frame shows the whole person, standing.
Findings CheckAgainstSubject(const SequenceReader& sequence) {
  const SequenceInfo& info = sequence.info();
  const DepthImage first = sequence.ReadDepth(0);
  std::vector<double> depths;
  for (const float z : first.pixels()) {
    if (z > 0.0f) depths.push_back(z);
  }
  if (depths.size() < static_cast<std::size_t>(kFewPixels)) return {};
  const double median_m = Quantile(depths, 0.5);
  if (median_m < kNearestBody_m || median_m > kFarthestBody_m)
    return {Impossible(
        "depth/{}: the median depth is {:.4g} m, expected a person {:g} to {:g} m "
        "away; is depth_unit_m {:g} right?",
        SequenceFiles::FrameName(0), median_m, kNearestBody_m, kFarthestBody_m, info.depth_unit_m)};
  if (!info.subject) return {};
  const double seen_m = ApparentHeight(first, info.camera);
  const double ratio = seen_m / sequence.subject().attributes.height_m;
  if (ratio <= 0.0 || std::max(ratio, 1.0 / ratio) < kApparentSize) return {};
  return {
      Warning("depth/{}: what it shows is {:.3g} m high, the subject {:.3g} m: {}; does the "
              "image hold the whole person and no background, is depth_unit_m {:g} right, and "
              "is the camera of this resolution?",
              SequenceFiles::FrameName(0), seen_m, sequence.subject().attributes.height_m,
              TimesTooLarge(ratio), info.depth_unit_m)};
}

}  // namespace

Findings CheckDepth(const SequenceReader& sequence, const std::vector<int>& frames) {
  if (sequence.info().surface) return CheckAgainstSurface(sequence, frames);
  if (!sequence.info().joints.empty()) return CheckAgainstJoints(sequence, frames);
  return CheckAgainstSubject(sequence);
}

}  // namespace vitruvia
