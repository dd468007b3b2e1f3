#include "diagnosis/joint_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/absent.h"
#include "core/progress.h"
#include "geometry/zbuffer.h"
#include "math/segment.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

constexpr double kLeafLength_m = 0.12;  // of hand, foot and head beyond their joints
constexpr int kSamplesOfBone = 5;
constexpr double kNearBone_m = 0.05;     // beyond its flesh: pixels that are counted as the bone's
constexpr int kMostPixels = 6000;        // of a frame that are looked at
constexpr double kGaussianMad = 1.4826;  // standard deviation over median absolute deviation
// Of a usual body, in the order of BoneId, metres.
constexpr std::array<double, kBoneCount> kUsualRadii = {0.14,  0.13,  0.13, 0.06,  0.09,  0.05,
                                                        0.04,  0.035, 0.05, 0.04,  0.035, 0.08,
                                                        0.055, 0.04,  0.08, 0.055, 0.04};

using JointPositions = std::vector<std::optional<Vector3d>>;

using Segments = std::vector<std::optional<Segment>>;  // by bone

int FirstChild(int bone) {
  for (int child = bone + 1; child < kBoneCount; ++child) {
    if (Bones()[child].parent == bone) return child;
  }
  return -1;
}

// A bone from its own joint to the next one; a leaf goes on as its parent does.
Segments BoneSegments(const JointPositions& joints) {
  Segments segments(kBoneCount);
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (!joints[bone]) continue;
    const int child = FirstChild(bone), parent = Bones()[bone].parent;
    if (child >= 0) {
      if (joints[child]) segments[bone] = {*joints[bone], *joints[child]};
    } else if (joints[parent]) {
      const Vector3d along = *joints[bone] - *joints[parent];
      const double length_m = along.norm();
      if (length_m > 0.0)
        segments[bone] = {*joints[bone], *joints[bone] + kLeafLength_m / length_m * along};
    }
  }
  return segments;
}

// The bone that moves the joint.
int LimbOf(int joint) { return std::max(0, Bones()[joint].parent); }

bool AreNeighbours(int a, int b) {
  const int parent_a = Bones()[a].parent, parent_b = Bones()[b].parent;
  return a == b || parent_a == b || parent_b == a || parent_a == parent_b;
}

// Between a bone's flesh and the nearest other bone's that is no neighbour.
double GapOfBone(const Segments& segments, int bone,
                 const std::array<double, kBoneCount>& radii_m) {
  double gap_m = std::numeric_limits<double>::infinity();
  if (!segments[bone]) return gap_m;
  for (int other = 0; other < kBoneCount; ++other) {
    if (!segments[other] || AreNeighbours(bone, other)) continue;
    for (int i = 0; i < kSamplesOfBone; ++i) {
      const double share = (i + 1.0) / kSamplesOfBone;
      const Vector3d point = (1.0 - share) * segments[bone]->from + share * segments[bone]->to;
      gap_m = std::min(gap_m, segments[other]->Distance(point) - radii_m[bone] - radii_m[other]);
    }
  }
  return gap_m;
}

// Of arm or leg, from the bone above the joint to the end; infinite for a joint of the trunk.
double GapOfLimb(const Segments& segments, int joint,
                 const std::array<double, kBoneCount>& radii_m) {
  double gap_m = std::numeric_limits<double>::infinity();
  if (joint <= static_cast<int>(BoneId::kHead)) return gap_m;
  if (LimbOf(joint) > static_cast<int>(BoneId::kHead))
    gap_m = GapOfBone(segments, LimbOf(joint), radii_m);
  for (int bone = joint; bone >= 0; bone = FirstChild(bone))
    gap_m = std::min(gap_m, GapOfBone(segments, bone, radii_m));
  return gap_m;
}

JointPositions TrueJoints(const SequenceReader& sequence, const JointTruth& truth) {
  JointPositions joints(kBoneCount);
  for (std::size_t j = 0; j < truth.positions.size(); ++j) {
    const int bone = FindJoint(sequence.info().joints[j]);
    if (bone >= 0 && truth.Knows(j)) joints[bone] = truth.positions[j];
  }
  return joints;
}

// Noise-free depth, rendered from the true surface if there is one.
class CleanDepth {
 public:
  explicit CleanDepth(const SequenceReader& sequence)
      : sequence_(sequence), zbuffer_(sequence.info().camera) {}

  const DepthImage* Render(int frame) {
    if (sequence_.info().surface)
      return &zbuffer_.Render(sequence_.ReadTrueVertices(frame),
                              sequence_.true_rest_mesh().triangles);
    if (!sequence_.info().own_surfaces) return nullptr;
    const TriangleMesh surface = sequence_.ReadTrueSurface(frame);
    return &zbuffer_.Render(surface.vertices, surface.triangles);
  }

 private:
  const SequenceReader& sequence_;
  ZBuffer zbuffer_;
};

// The bone whose surface is nearest to a point; −1 if none is near.
int BoneAt(const Vector3d& point, const Segments& segments,
           const std::array<double, kBoneCount>& radii_m) {
  int nearest = -1;
  double least_m = kNearBone_m;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (!segments[bone]) continue;
    const double beyond_m = segments[bone]->Distance(point) - radii_m[bone];
    if (beyond_m >= least_m) continue;
    least_m = beyond_m;
    nearest = bone;
  }
  return nearest;
}

// Of each bone: how many pixels were measured on it, and how far they are off.
struct PixelsOfBones {
  std::array<int, kBoneCount> count{};
  std::array<std::vector<double>, kBoneCount> residuals_m;
  int measured = 0;
};

PixelsOfBones CountPixels(const DepthImage& depth, const DepthImage* clean,
                          const PinholeCamera& camera, const Segments& segments,
                          const std::array<double, kBoneCount>& radii_m) {
  PixelsOfBones pixels;
  pixels.measured =
      static_cast<int>(std::ranges::count_if(depth.pixels(), [](float z) { return z > 0.0f; }));
  int every = 1;
  while (pixels.measured / (every * every) > kMostPixels) ++every;
  for (int v = 0; v < depth.height(); v += every) {
    for (int u = 0; u < depth.width(); u += every) {
      const double z = depth(u, v);
      if (z <= 0.0) continue;
      const int bone = BoneAt(camera.Unproject<double>(u, v, z), segments, radii_m);
      if (bone < 0) continue;
      pixels.count[bone] += every * every;
      if (clean != nullptr && (*clean)(u, v) > 0.0f)
        pixels.residuals_m[bone].push_back(std::abs(z - (*clean)(u, v)));
    }
  }
  return pixels;
}

}  // namespace

std::array<double, kBoneCount> BoneRadii(const SequenceReader& sequence) {
  if (!sequence.info().subject) return kUsualRadii;
  const BodyModel& body = sequence.subject();
  std::array<double, kBoneCount> sums{}, counts{};
  for (std::size_t v = 0; v < body.rest.vertices.size(); ++v) {
    const int bone = body.weights.bones[v][0];
    const Segment axis{body.skeleton.joints[bone], body.skeleton.tips[bone]};
    sums[bone] += axis.Distance(body.rest.vertices[v].cast<double>());
    counts[bone] += 1.0;
  }
  std::array<double, kBoneCount> radii_m = kUsualRadii;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    if (counts[bone] > 0.0) radii_m[bone] = sums[bone] / counts[bone];
  }
  return radii_m;
}

std::vector<FrameEvidence> GatherEvidence(const SequenceReader& sequence) {
  if (sequence.info().joints.empty()) return {};
  const PinholeCamera& camera = sequence.info().camera;
  const std::array<double, kBoneCount> radii_m = BoneRadii(sequence);
  CleanDepth clean(sequence);
  std::vector<FrameEvidence> frames;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    ThrowIfInterrupted();
    const JointTruth& truth = sequence.true_joints(frame);
    FrameEvidence evidence{TrueJoints(sequence, truth), std::vector<JointEvidence>(kBoneCount)};
    const Segments segments = BoneSegments(evidence.truth);
    const PixelsOfBones pixels =
        CountPixels(sequence.ReadDepth(frame), clean.Render(frame), camera, segments, radii_m);
    evidence.measured_pixels = pixels.measured;
    for (std::size_t j = 0; j < truth.positions.size(); ++j) {
      const int joint = FindJoint(sequence.info().joints[j]);
      if (joint < 0 || !evidence.truth[joint]) continue;
      JointEvidence& found = evidence.joints[joint];
      const int limb = LimbOf(joint);
      found.in_view = camera.InView(*evidence.truth[joint]);
      found.visible = truth.visible[j];
      if (!frames.empty() && frames.back().truth[joint])
        found.step_m = (*evidence.truth[joint] - *frames.back().truth[joint]).norm();
      found.gap_m = GapOfLimb(segments, joint, radii_m);
      found.pixels = pixels.count[limb];
      found.noise_m = pixels.residuals_m[limb].empty()
                          ? kAbsent
                          : kGaussianMad * Quantile(pixels.residuals_m[limb], 0.5);
    }
    frames.push_back(std::move(evidence));
  }
  return frames;
}

}  // namespace vitruvia
