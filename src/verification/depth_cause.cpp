#include "verification/depth_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "geometry/zbuffer.h"
#include "math/evenly_spread.h"
#include "math/statistics.h"
#include "verification/checks.h"
#include "verification/depth_changes.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

constexpr std::array kOtherResolutions = {0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.5, 2.0, 3.0, 4.0};
constexpr int kLongestDelay = 12;  // frames

// One frame's depth and truth, and the camera that relates them.
struct Evidence {
  DepthImage depth;
  std::vector<Vector3f> vertices;  // of a true surface; none: there are only joints
  std::vector<Vector3d> joints;    // that are visible
  PinholeCamera camera;
};

// A possible mistake and its correction.
struct Candidate {
  std::string cause;
  std::function<void(Evidence&)> undo;
};

Evidence EvidenceOf(const SequenceReader& sequence, int depth_frame, int truth_frame) {
  Evidence e{sequence.ReadDepth(depth_frame), {}, {}, sequence.info().camera};
  if (sequence.info().surface) {
    e.vertices = sequence.ReadTrueVertices(truth_frame);
  } else {
    e.joints = VisibleTrueJoints(sequence.true_joints(truth_frame));
  }
  return e;
}

// The share of the truth that depth agrees with, over some frames.
double ScoreOf(const SequenceReader& sequence, const std::vector<Evidence>& frames,
               const std::function<void(Evidence&)>& undo) {
  DepthAgreement surface;
  JointAgreement joints;
  for (Evidence e : frames) {
    undo(e);
    if (sequence.info().surface) {
      ZBuffer zbuffer(e.camera);
      Add(Compare(e.depth, zbuffer.Render(e.vertices, sequence.true_rest_mesh().triangles)),
          surface);
    } else {
      AddFrame(e.depth, e.camera, e.joints, joints);
    }
  }
  return sequence.info().surface ? surface.Score() : joints.Score();
}

void ApplyAxes(const Matrix3<double>& map, Evidence& e) {
  const Matrix3<float> narrow = map.cast<float>();
  for (Vector3f& v : e.vertices) v = narrow * v;
  for (Vector3d& j : e.joints) j = map * j;
}

void ScaleTruth(double factor, Evidence& e) { ApplyAxes(factor * Matrix3<double>::Identity(), e); }

PinholeCamera OfResolution(const PinholeCamera& c, double k) {
  return {c.width, c.height, k * c.fx, k * c.fy, k * (c.cx + 0.5) - 0.5, k * (c.cy + 0.5) - 0.5};
}

std::string CameraText(const PinholeCamera& c) {
  return fmt::format("fx {:.4g}, fy {:.4g}, cx {:.4g}, cy {:.4g}", c.fx, c.fy, c.cx, c.cy);
}

void AddImageCandidates(const SequenceInfo& info, std::vector<Candidate>& all) {
  all.push_back(
      {"the two bytes of each depth value are swapped",
       [unit = info.depth_unit_m](Evidence& e) { e.depth = WithSwappedBytes(e.depth, unit); }});
  all.push_back({"the images are mirrored left to right",
                 [](Evidence& e) { e.depth = MirroredSideways(e.depth); }});
  all.push_back({"the images are upside down, rows in reverse",
                 [](Evidence& e) { e.depth = TurnedUpsideDown(e.depth); }});
  all.push_back({"the images are turned by 180 degrees",
                 [](Evidence& e) { e.depth = TurnedUpsideDown(MirroredSideways(e.depth)); }});
  all.push_back({"depth holds distances from the camera instead of z",
                 [](Evidence& e) { e.depth = FromRayLengths(e.depth, e.camera); }});
}

void AddCameraCandidates(const PinholeCamera& c, std::vector<Candidate>& all) {
  const auto add = [&](const char* cause, const PinholeCamera& camera) {
    all.push_back({fmt::format("{}: {} instead of {}", cause, CameraText(camera), CameraText(c)),
                   [camera](Evidence& e) { e.camera = camera; }});
  };
  const double center_u = (c.width - 1) / 2.0, center_v = (c.height - 1) / 2.0;
  for (const double k : kOtherResolutions) {
    add("the intrinsics are of another resolution", OfResolution(c, k));
    add("the focal lengths are of another resolution",
        {c.width, c.height, k * c.fx, k * c.fy, c.cx, c.cy});
  }
  add("the principal point is not the image's",
      {c.width, c.height, c.fx, c.fy, center_u, center_v});
  add("cx and cy are swapped", {c.width, c.height, c.fx, c.fy, c.cy, c.cx});
}

void AddTruthCandidates(std::vector<Candidate>& all) {
  for (const AxisMap& map : AxisMaps()) {
    all.push_back({"the truth is " + AxisCause(map, AxesOf::kCamera),
                   [map](Evidence& e) { ApplyAxes(map.expected_from_file, e); }});
  }
}

// Depth of a person has one ratio to the truth; anything else scatters.
void AddScaleCandidates(const SequenceInfo& info, const std::vector<double>& ratios,
                        std::vector<Candidate>& all) {
  if (ratios.empty()) return;
  const double ratio = Quantile(ratios, 0.5);
  all.push_back({fmt::format("depth looks {} ({:.4g} times the truth's): {}", TimesTooLarge(ratio),
                             ratio, DepthUnitCause(ratio, info.depth_unit_m)),
                 [ratio](Evidence& e) { e.depth = Scaled(e.depth, 1.0 / ratio); }});
  all.push_back(
      {fmt::format("the truth is {}{}", TimesTooLarge(1.0 / ratio), LengthUnitCause(1.0 / ratio)),
       [ratio](Evidence& e) { ScaleTruth(ratio, e); }});
}

struct Best {
  std::string cause;
  double score = 0.0;
};

void Try(const std::string& cause, double score, Best& best) {
  if (score > best.score) best = {cause, score};
}

std::string Search(const SequenceReader& sequence, double as_stated,
                   const std::vector<double>& ratios) {
  const SequenceInfo& info = sequence.info();
  const std::vector<int> chosen = EvenlySpread(info.frames, kFramesForCause);
  std::vector<Evidence> frames;
  for (const int frame : chosen) frames.push_back(EvidenceOf(sequence, frame, frame));

  std::vector<Candidate> candidates;
  AddScaleCandidates(info, ratios, candidates);
  AddImageCandidates(info, candidates);
  AddCameraCandidates(info.camera, candidates);
  AddTruthCandidates(candidates);
  Best best;
  for (const Candidate& candidate : candidates)
    Try(candidate.cause, ScoreOf(sequence, frames, candidate.undo), best);
  for (int delay = -kLongestDelay; delay <= kLongestDelay; ++delay) {
    std::vector<Evidence> shifted;
    for (const int frame : chosen) {
      const int truth = frame + delay;
      if (truth >= 0 && truth < info.frames && delay != 0)
        shifted.push_back(EvidenceOf(sequence, frame, truth));
    }
    if (shifted.size() < 2) continue;
    Try(fmt::format("frame i of depth/ shows frame i {} {} of the truth", delay < 0 ? "-" : "+",
                    std::abs(delay)),
        ScoreOf(sequence, shifted, [](Evidence&) {}), best);
  }
  if (best.score < kCauseScore || best.score < kCauseGain * as_stated)
    return "no change of unit, byte order, axes, mirror image, resolution or time explains it; are "
           "depth and truth of the same recording?";
  return fmt::format("{} ({:.0f} % of the truth agrees once that is undone, {:.0f} % as it is)",
                     best.cause, 100.0 * best.score, 100.0 * as_stated);
}

}  // namespace

JointAgreement CompareWithJoints(const SequenceReader& sequence, const std::vector<int>& frames) {
  JointAgreement sum;
  for (const int frame : frames) {
    const DepthImage depth = sequence.ReadDepth(frame);
    const bool is_lost = std::none_of(depth.pixels().begin(), depth.pixels().end(),
                                      [](float z) { return z > 0.0f; });
    if (is_lost) continue;
    AddFrame(depth, sequence.info().camera, VisibleTrueJoints(sequence.true_joints(frame)), sum);
  }
  return sum;
}

std::string CauseOfDisagreement(const SequenceReader& sequence, const DepthAgreement& as_stated) {
  return Search(sequence, as_stated.Score(), as_stated.ratios);
}

std::string CauseOfDisagreement(const SequenceReader& sequence, const JointAgreement& as_stated) {
  return Search(sequence, as_stated.Score(), as_stated.ratios);
}

}  // namespace vitruvia
