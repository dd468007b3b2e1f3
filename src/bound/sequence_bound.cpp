#include "bound/sequence_bound.h"

#include <algorithm>
#include <cmath>

#include "config/json_settings.h"
#include "core/error.h"

namespace vitruvia {
namespace {

// A measurement at least this much nearer than the true surface belongs to an occluder.
constexpr float kHiddenBehind_m = 0.1f;

SensorSettings SensorOf(const SequenceReader& sequence) {
  return ReadSettings<SensorSettings>(sequence.info().provenance.at("scene").at("sensor"),
                                      {sequence.folder() / "sequence.json", "provenance.scene"});
}

bool IsEmpty(const DepthImage& depth) {
  return std::all_of(depth.pixels().begin(), depth.pixels().end(),
                     [](float z) { return !(z > 0.0f); });
}

// Removes pixels with occluders, which the true rendering does not contain.
void RemoveHidden(const DepthImage& true_depth, const DepthImage& measured,
                  Image<PixelNoise>& noise) {
  for (std::size_t i = 0; i < noise.pixels().size(); ++i) {
    const float z = measured.pixels()[i];
    if (z > 0.0f && z < true_depth.pixels()[i] - kHiddenBehind_m)
      noise.pixels()[i].measured_share = 0.0;
  }
}

std::array<Vector3d, kBoneCount> JointsOf(const SequenceReader& sequence, int frame) {
  std::array<Vector3d, kBoneCount> joints;
  for (std::size_t j = 0; j < sequence.info().joints.size(); ++j) {
    const int bone = FindJoint(sequence.info().joints[j]);
    if (bone >= 0) joints[bone] = sequence.true_joints(frame).positions[j];
  }
  return joints;
}

}  // namespace

std::string SequenceBound::Problem(const SequenceInfo& info) {
  if (!info.surface) return "the sequence has no true surface with the subject's triangles";
  if (!info.subject) return "the sequence has no subject, whose skinning the bound takes";
  if (!FindUnmatchedJoints(info.joints).only_in_skeleton.empty())
    return "the sequence has not all joints of the skeleton";
  const auto scene = info.provenance.find("scene");
  if (scene == info.provenance.end() || !scene->is_object() || !scene->contains("sensor"))
    return "the sequence's provenance has no sensor model";
  return "";
}

SequenceBound::SequenceBound(const SequenceReader& sequence, const PosePrior& prior)
    : sequence_(sequence), prior_(PriorInformation(prior)) {
  const std::string problem = Problem(sequence.info());
  if (!problem.empty()) {
    throw DataError(
        fmt::format("{}: no bound can be computed: {}", sequence.folder().string(), problem));
  }
  sensor_ = SensorOf(sequence);
  shares_ = SharesOf(TransferredWeights(sequence.subject(), sequence.true_rest_mesh().vertices));
}

std::optional<FrameBound> SequenceBound::At(int frame) const {
  const DepthImage measured = sequence_.ReadDepth(frame);
  if (IsEmpty(measured)) return {};
  const PinholeCamera& camera = sequence_.info().camera;
  const std::vector<Vector3f> vertices = sequence_.ReadTrueVertices(frame);
  const std::array<Vector3d, kBoneCount> joints = JointsOf(sequence_, frame);
  const TrueBody body{vertices, sequence_.true_rest_mesh().triangles, shares_, joints};
  const Image<SurfaceSample> samples = SampleSurface(vertices, body.triangles, camera);
  const DepthImage true_depth = DepthOf(samples);
  Image<PixelNoise> noise = ExpectedNoise(true_depth, camera, sensor_);
  RemoveHidden(true_depth, measured, noise);
  const double area_px = sensor_.shared_px * sensor_.shared_px;
  const std::array<Matrix3<double>, kBoneCount> covariances =
      JointBounds(prior_ + PoseInformation(body, samples, noise, camera, area_px), joints);
  FrameBound bound;
  std::transform(covariances.begin(), covariances.end(), bound.joint_m.begin(),
                 [](const Matrix3<double>& covariance) { return std::sqrt(covariance.trace()); });
  return bound;
}

}  // namespace vitruvia
