#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/zbuffer.h"
#include "math/statistics.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence_files.h"
#include "verification/checks.h"
#include "verification/depth_agreement.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

// Pixels of one frame that should show the true surface, and those of them that show none or
// another.
struct FrameDifference {
  int frame = 0;
  long rendered = 0, differing = 0;

  double Share() const { return static_cast<double>(differing) / static_cast<double>(rendered); }
};

// Flags of joints that the image or the true surface contradicts.
struct FlagCounts {
  int decided = 0, wrongly_visible = 0, wrongly_hidden = 0;
};

// What the frames say together.
struct FrameEvidence {
  std::vector<FrameDifference> differences;
  std::array<MirrorVotes, 2> neighbours;  // for the truth of the frame before, of the one after
  FlagCounts flags;
};

// Something else may stand before the person, so depth well in front of the surface says nothing.
FrameDifference DifferenceOf(const DepthImage& measured, const DepthImage& rendered, int frame) {
  FrameDifference difference{.frame = frame};
  for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
    const float z = measured.pixels()[i], truth = rendered.pixels()[i];
    if (!(truth > 0.0f)) continue;
    ++difference.rendered;
    const float behind_m = z - truth;
    const bool is_before = z > 0.0f && behind_m < -kBeforeSurface_m;
    difference.differing += std::abs(behind_m) > kSameMomentWithin_m && !is_before ? 1 : 0;
  }
  return difference;
}

// A joint is certainly hidden if the body's own surface covers it, and certainly visible if the
// image shows that surface and it does not cover the joint.
void CountFlags(const SequenceReader& sequence, int frame, const DepthImage& measured,
                const DepthImage& rendered, FlagCounts& counts) {
  const JointTruth& truth = sequence.true_joints(frame);
  const PinholeCamera& camera = sequence.info().camera;
  for (std::size_t j = 0; j < truth.positions.size(); ++j) {
    const auto pixel = camera.PixelOf(truth.positions[j]);
    if (!truth.Knows(j) || !pixel) continue;
    const float skin = rendered(pixel->u, pixel->v), z = measured(pixel->u, pixel->v);
    if (!(skin > 0.0f)) continue;
    const double below_skin = JointBelowSkin(FindJoint(sequence.info().joints[j]));
    const bool in_front = SeesJoint(truth.positions[j], below_skin, rendered, camera);
    const bool is_measured = z > 0.0f && std::abs(z - skin) <= kAgreeWithin_m;
    if (in_front && !is_measured) continue;
    ++counts.decided;
    counts.wrongly_visible += truth.visible[j] && !in_front ? 1 : 0;
    counts.wrongly_hidden += !truth.visible[j] && in_front ? 1 : 0;
  }
}

FrameEvidence Look(const SequenceReader& sequence, const std::vector<int>& frames) {
  FrameEvidence evidence;
  ZBuffer zbuffer(sequence.info().camera), other_zbuffer(sequence.info().camera);
  const std::vector<Triangle>& triangles = sequence.true_rest_mesh().triangles;
  for (const int frame : frames) {
    const DepthImage measured = sequence.ReadDepth(frame);
    const auto has_depth = [](float z) { return z > 0.0f; };
    if (std::none_of(measured.pixels().begin(), measured.pixels().end(), has_depth))
      continue;  // a lost frame
    const DepthImage& rendered = zbuffer.Render(sequence.ReadTrueVertices(frame), triangles);
    const FrameDifference difference = DifferenceOf(measured, rendered, frame);
    if (difference.rendered < kFewPixels) continue;
    evidence.differences.push_back(difference);
    for (const int k : {0, 1}) {
      const int other = frame + (k == 0 ? -1 : 1);
      if (other < 0 || other >= sequence.info().frames) continue;
      Vote(measured, rendered, other_zbuffer.Render(sequence.ReadTrueVertices(other), triangles),
           evidence.neighbours[static_cast<std::size_t>(k)]);
    }
    if (!sequence.info().joints.empty())
      CountFlags(sequence, frame, measured, rendered, evidence.flags);
  }
  return evidence;
}

std::optional<Finding> ShiftProblem(const std::array<MirrorVotes, 2>& votes) {
  for (const std::size_t k : {0u, 1u}) {
    const MirrorVotes& v = votes[k];
    if (v.for_mirror <= kMirrorFewestVotes ||
        static_cast<double>(v.for_mirror) <= kMirrorVotes * static_cast<double>(v.for_truth))
      continue;
    return Warning(
        "depth/: the images look shifted in time against the truth: where the true surface of a "
        "frame and of the one {} it differ, {} pixels have that one's depth and {} their own "
        "frame's; do both begin with the same frame?",
        k == 0 ? "before" : "after", v.for_mirror, v.for_truth);
  }
  return std::nullopt;
}

std::optional<Finding> MomentProblem(const std::vector<FrameDifference>& differences) {
  if (differences.empty()) return std::nullopt;
  std::vector<double> shares;
  for (const FrameDifference& d : differences) shares.push_back(d.Share());
  const double usual = Quantile(shares, 0.25);
  const double limit = kUsualDifference * usual + kFrameDifference;
  const FrameDifference* worst = nullptr;
  int count = 0;
  for (const FrameDifference& d : differences) {
    if (d.Share() <= limit || d.differing < kFewDifferingPixels) continue;
    ++count;
    if (worst == nullptr || d.Share() > worst->Share()) worst = &d;
  }
  if (worst == nullptr) return std::nullopt;
  return Warning(
      "depth/{}: {} of {} pixels of the true surface have no depth or one more than {:g} m from it "
      "({:.1f} %, {:.1f} % in a usual frame); {} of {} frames differ so; is the image, or the "
      "truth, of another moment?",
      SequenceFiles::FrameName(worst->frame), worst->differing, worst->rendered,
      kSameMomentWithin_m, 100.0 * worst->Share(), 100.0 * usual, count, differences.size());
}

std::optional<Finding> FlagProblem(const FlagCounts& flags) {
  const int wrong = flags.wrongly_visible + flags.wrongly_hidden;
  if (flags.decided < kFewestFlags || wrong <= kWrongFlags * flags.decided) return std::nullopt;
  return Warning(
      "truth/joints.json: \"visible\" disagrees with the images: of {} joints {} are marked "
      "visible though the body hides them, and {} hidden though the image shows the skin before "
      "them; are the flags meant otherwise?",
      flags.decided, flags.wrongly_visible, flags.wrongly_hidden);
}

}  // namespace

Findings CheckFrames(const SequenceReader& sequence, const std::vector<int>& frames) {
  if (!sequence.info().surface) return {};
  const FrameEvidence evidence = Look(sequence, frames);
  Findings findings;
  for (std::optional<Finding>& problem :
       std::array{ShiftProblem(evidence.neighbours), MomentProblem(evidence.differences),
                  FlagProblem(evidence.flags)}) {
    if (problem) findings.push_back(std::move(*problem));
  }
  return findings;
}

}  // namespace vitruvia
