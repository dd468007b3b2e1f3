#include <algorithm>
#include <cmath>
#include <optional>

#include "math/rigid_fit.h"
#include "math/statistics.h"
#include "verification/checks.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

constexpr const char* kVertices = "truth/vertices.bin";
constexpr std::size_t kEdges = 500;       // that are measured
constexpr std::size_t kSkinOfJoint = 12;  // vertices round a joint that follow it
constexpr std::size_t kCarriers = 60;     // vertices round a joint whose motion carries it

// Posed length by rest length of some edges.
std::vector<double> EdgeRatios(const TriangleMesh& rest, const std::vector<Vector3f>& posed) {
  const std::size_t step = std::max<std::size_t>(1, rest.triangles.size() / kEdges);
  std::vector<double> ratios;
  for (std::size_t t = 0; t < rest.triangles.size(); t += step) {
    const auto [a, b, c] = rest.triangles[t];
    const double length = (rest.vertices[b] - rest.vertices[a]).norm();
    if (length > 0.0) ratios.push_back((posed[b] - posed[a]).norm() / length);
  }
  return ratios;
}

std::optional<Finding> EdgeProblem(const TriangleMesh& rest, const std::vector<Vector3f>& posed,
                                   int frame) {
  const std::vector<double> ratios = EdgeRatios(rest, posed);
  if (ratios.empty()) return std::nullopt;
  const double ratio = Quantile(ratios, 0.5);
  const auto kept = std::count_if(ratios.begin(), ratios.end(),
                                  [&](double r) { return r > 0.5 * ratio && r < 2.0 * ratio; });
  if (static_cast<double>(kept) < kEdgesKeptShare * static_cast<double>(ratios.size()))
    return Impossible(
        "{}: frame {}: only {} of {} edges keep their length of truth/mesh.ply within a factor of "
        "2; are its vertices in another order, or bytes swapped?",
        kVertices, frame, kept, ratios.size());
  if (std::abs(ratio - 1.0) > kEdgeScaleWithin)
    return Impossible(
        "{}: frame {}: the vertices are {} for truth/mesh.ply: edges have {:.4g} "
        "times their length at rest in the median{}",
        kVertices, frame, TimesTooLarge(ratio), ratio, LengthUnitCause(ratio));
  return std::nullopt;
}

std::optional<Finding> SideProblem(const TriangleMesh& rest, const std::vector<Vector3f>& posed,
                                   int frame) {
  const double at_rest = EnclosedVolume(rest);
  const double now = EnclosedVolume({posed, rest.triangles});
  if (at_rest > 0.0 && now < -kVolumeShare * at_rest)
    return Impossible(
        "{}: frame {}: the surface is turned inside out (volume {:.4f} m³, {:.4f} at "
        "rest): mirrored, one axis has the wrong sign; is y up instead of down?",
        kVertices, frame, now, at_rest);
  const auto behind =
      std::count_if(posed.begin(), posed.end(), [](const Vector3f& v) { return v.z() <= 0.0f; });
  if (2 * static_cast<std::size_t>(behind) > posed.size())
    return Impossible(
        "{}: frame {}: {} of {} vertices are behind the camera (z ≤ 0); is y up and "
        "z backwards instead of y down and z forward?",
        kVertices, frame, behind, posed.size());
  return std::nullopt;
}

// Vertices far from where their neighbours are, over all frames.
struct StrayVertices {
  int frames = 0, first_frame = 0;
  std::int32_t vertex = 0;
  double edge_m = 0.0, rest_edge_m = 0.0;

  // Whether this frame has one.
  bool Look(const TriangleMesh& rest, const std::vector<Vector3f>& posed, int frame) {
    for (const Triangle& triangle : rest.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = triangle[k], b = triangle[(k + 1) % 3];
        const double length_m = (posed[b] - posed[a]).norm();
        if (length_m < kStrayEdge_m) continue;
        const double at_rest_m = (rest.vertices[b] - rest.vertices[a]).norm();
        if (length_m < kStrayEdgeRatio * at_rest_m) continue;
        if (frames++ == 0) {
          first_frame = frame;
          vertex = a;
          edge_m = length_m;
          rest_edge_m = at_rest_m;
        }
        return true;
      }
    }
    return false;
  }
};

// The vertices of the true surface that lie nearest to each joint of the skeleton at rest.
struct SkinOfJoints {
  std::vector<int> joints;  // in the sequence's list
  std::vector<int> bones;   // in the skeleton
  std::vector<std::vector<std::int32_t>> vertices;
  std::vector<double> rest_m;  // from the joint to the mean of its vertices
  std::vector<std::vector<std::int32_t>> carriers;
  std::vector<Vector3d> rest_joints;
};

Vector3d MeanOf(const std::vector<std::int32_t>& indices, const std::vector<Vector3f>& vertices) {
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t v : indices) sum += vertices[static_cast<std::size_t>(v)].cast<double>();
  return sum / static_cast<double>(indices.size());
}

SkinOfJoints FindSkin(const SequenceReader& sequence) {
  const TriangleMesh& rest = sequence.true_rest_mesh();
  SkinOfJoints skin;
  const std::size_t count = std::min(kSkinOfJoint, rest.vertices.size());
  const std::size_t carriers = std::min(kCarriers, rest.vertices.size());
  std::vector<std::pair<float, std::int32_t>> order(rest.vertices.size());
  for (std::size_t j = 0; j < sequence.info().joints.size(); ++j) {
    const int bone = FindJoint(sequence.info().joints[j]);
    if (bone < 0) continue;
    const Vector3d& joint = sequence.subject().skeleton.joints[static_cast<std::size_t>(bone)];
    const Vector3f at = joint.cast<float>();
    for (std::size_t v = 0; v < order.size(); ++v)
      order[v] = {(rest.vertices[v] - at).squaredNorm(), static_cast<std::int32_t>(v)};
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(carriers),
                      order.end());
    std::vector<std::int32_t> nearest, round;
    for (std::size_t k = 0; k < count; ++k) nearest.push_back(order[k].second);
    for (std::size_t k = 0; k < carriers; ++k) round.push_back(order[k].second);
    skin.joints.push_back(static_cast<int>(j));
    skin.bones.push_back(bone);
    skin.rest_m.push_back((MeanOf(nearest, rest.vertices) - joint).norm());
    skin.vertices.push_back(std::move(nearest));
    skin.carriers.push_back(std::move(round));
    skin.rest_joints.push_back(joint);
  }
  return skin;
}

// Joints and where the true surface has them, of one or more frames.
struct JointPlaces {
  std::vector<Vector3d> stated, mirrored, on_surface;  // mirrored: stated of the other side
  std::vector<double> within_m;

  template <class Change>
  double Share(const std::vector<Vector3d>& joints, const Change& change) const {
    int in_place = 0;
    for (std::size_t i = 0; i < joints.size(); ++i)
      in_place += (change(joints[i]) - on_surface[i]).norm() < within_m[i] ? 1 : 0;
    return joints.empty() ? 1.0
                          : static_cast<double>(in_place) / static_cast<double>(joints.size());
  }
};

void AddFrame(const SkinOfJoints& skin, const JointTruth& truth,
              const std::vector<Vector3f>& vertices, JointPlaces& places) {
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const auto joint = static_cast<std::size_t>(skin.joints[i]);
    const int mirror = Bones()[static_cast<std::size_t>(skin.bones[i])].mirror;
    const auto other = std::find(skin.bones.begin(), skin.bones.end(), mirror);
    if (!truth.Knows(joint) || other == skin.bones.end()) continue;
    const auto mirror_joint =
        static_cast<std::size_t>(skin.joints[static_cast<std::size_t>(other - skin.bones.begin())]);
    if (!truth.Knows(mirror_joint)) continue;
    places.stated.push_back(truth.positions[joint]);
    places.mirrored.push_back(truth.positions[mirror_joint]);
    places.on_surface.push_back(MeanOf(skin.vertices[i], vertices));
    places.within_m.push_back(skin.rest_m[i] + kJointFromSkin_m);
  }
}

// How far each joint of the skin's list is from where the rigid motion of the vertices round it
// carries it, in one frame after the other.
struct CarriedJoints {
  std::vector<std::vector<double>> off_m;  // of each joint, the frames that know it

  void AddFrame(const SkinOfJoints& skin, const TriangleMesh& rest, const JointTruth& truth,
                const std::vector<Vector3f>& vertices) {
    off_m.resize(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
      const auto joint = static_cast<std::size_t>(skin.joints[i]);
      if (!truth.Knows(joint)) continue;
      const std::vector<std::int32_t>& carriers = skin.carriers[i];
      const Rigidd posed_from_rest = FitRigid(carriers.size(), [&](std::size_t k) -> PointPair {
        const auto v = static_cast<std::size_t>(carriers[k]);
        return {rest.vertices[v].cast<double>(), vertices[v].cast<double>()};
      });
      off_m[i].push_back((posed_from_rest * skin.rest_joints[i] - truth.positions[joint]).norm());
    }
  }
};

// Joints that lie near the surface's, but not where it has them.
std::optional<Finding> CarriedProblem(const CarriedJoints& carried, const SkinOfJoints& skin,
                                      const SequenceInfo& info) {
  std::size_t far = 0, all = 0, worst = 0;
  std::vector<double> medians;
  for (const std::vector<double>& off : carried.off_m) {
    all += off.size();
    far += static_cast<std::size_t>(
        std::count_if(off.begin(), off.end(), [](double m) { return m > kJointOfSkin_m; }));
    medians.push_back(off.empty() ? 0.0 : Quantile(off, 0.5));
    if (medians.back() > medians[worst]) worst = medians.size() - 1;
  }
  if (all == 0) return std::nullopt;
  const double share = static_cast<double>(far) / static_cast<double>(all);
  if (share <= kJointsOffSkin && medians[worst] <= kJointOfSkin_m) return std::nullopt;
  return Warning(
      "truth/joints.json: {:.0f} % of the joints lie more than {:g} m from where "
      "truth/vertices.bin carries them, \"{}\" {:.3g} m in the median; are they of other frames "
      "or another person, or is this joint another one?",
      100.0 * share, kJointOfSkin_m, info.joints[static_cast<std::size_t>(skin.joints[worst])],
      medians[worst]);
}

std::string CauseOf(const JointPlaces& places) {
  const auto as_is = [](const Vector3d& p) { return p; };
  if (places.Share(places.mirrored, as_is) >= kJointsOnSurface)
    return "left and right are swapped?";
  for (const AxisMap& map : AxisMaps()) {
    const auto turned = [&](const Vector3d& p) -> Vector3d { return map.expected_from_file * p; };
    if (places.Share(places.stated, turned) >= kJointsOnSurface)
      return AxisCause(map, AxesOf::kCamera) + "?";
  }
  std::array<std::vector<double>, 3> offsets;
  for (std::size_t i = 0; i < places.stated.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      offsets[static_cast<std::size_t>(axis)].push_back(places.stated[i][axis] -
                                                        places.on_surface[i][axis]);
  }
  const Vector3d offset(Quantile(offsets[0], 0.5), Quantile(offsets[1], 0.5),
                        Quantile(offsets[2], 0.5));
  const auto moved = [&](const Vector3d& p) -> Vector3d { return p - offset; };
  if (places.Share(places.stated, moved) >= kJointsOnSurface)
    return fmt::format(
        "they are moved by ({:.2f}, {:.2f}, {:.2f}) m against the surface: another "
        "frame of reference?",
        offset.x(), offset.y(), offset.z());
  return "are they of other frames, or in another order than sequence.json says?";
}

std::optional<Finding> JointProblem(const JointPlaces& places, std::size_t frames) {
  const double share = places.Share(places.stated, [](const Vector3d& p) { return p; });
  if (share >= kJointsOnSurface) return std::nullopt;
  std::vector<double> distances;
  for (std::size_t i = 0; i < places.stated.size(); ++i)
    distances.push_back((places.stated[i] - places.on_surface[i]).norm());
  return Impossible(
      "truth/joints.json: only {:.0f} % of the joints are where truth/vertices.bin has them "
      "(median distance {:.3g} m over {} frames): {}",
      100.0 * share, Quantile(distances, 0.5), frames, CauseOf(places));
}

}  // namespace

Findings CheckTrueSurface(const SequenceReader& sequence, const std::vector<int>& frames) {
  const SequenceInfo& info = sequence.info();
  if (!info.surface) return {};
  const bool has_joints = info.subject && !info.joints.empty();
  const SkinOfJoints skin = has_joints ? FindSkin(sequence) : SkinOfJoints();
  JointPlaces places;
  CarriedJoints carried;
  StrayVertices strays;
  for (const int frame : frames) {
    const std::vector<Vector3f> vertices = sequence.ReadTrueVertices(frame);
    const TriangleMesh& rest = sequence.true_rest_mesh();
    if (const auto problem = EdgeProblem(rest, vertices, frame)) return {*problem};
    const bool has_strays = strays.Look(rest, vertices, frame);  // these alone can turn a volume
    if (const auto problem = has_strays ? std::nullopt : SideProblem(rest, vertices, frame))
      return {*problem};
    if (!has_joints) continue;
    AddFrame(skin, sequence.true_joints(frame), vertices, places);
    if (!has_strays) carried.AddFrame(skin, rest, sequence.true_joints(frame), vertices);
  }
  if (const auto problem = JointProblem(places, frames.size())) return {*problem};
  Findings findings;
  if (const auto problem = CarriedProblem(carried, skin, info)) findings.push_back(*problem);
  if (strays.frames == 0) return findings;
  findings.push_back(Warning(
      "{}: frame {}: an edge at vertex {} is {:.4g} m long, {:.3g} m at rest; {} of {} frames have "
      "such edges; is a number damaged?",
      kVertices, strays.first_frame, strays.vertex, strays.edge_m, strays.rest_edge_m,
      strays.frames, frames.size()));
  return findings;
}

}  // namespace vitruvia
