#include "scoring/surface_score.h"

#include <limits>
#include <numbers>
#include <optional>

#include "body/skeleton.h"
#include "geometry/point_cloud.h"
#include "math/statistics.h"
#include "metrics/bone_motion.h"
#include "metrics/reconstruction_error.h"
#include "metrics/vertex_error.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

// Vertices that nearly follow one bone alone show how it turns.
constexpr float kRigidWeight = 0.9f;
RigidParts PartsOf(const BodyModel& subject) {
  std::vector<int> bone_of_vertex;
  for (std::size_t i = 0; i < subject.rest.vertices.size(); ++i) {
    const bool rigid = subject.weights.weights[i][0] >= kRigidWeight;
    bone_of_vertex.push_back(rigid ? subject.weights.bones[i][0] : -1);
  }
  return {subject.rest.vertices, bone_of_vertex, kBoneCount};
}

// The axes about which limbs can twist; zero for all other bones.
std::vector<Vector3d> LimbAxes(const Skeleton& skeleton) {
  std::vector<Vector3d> axes(kBoneCount, Vector3d::Zero());
  for (const BoneId id :
       {BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kRightUpperArm, BoneId::kRightForearm,
        BoneId::kLeftThigh, BoneId::kLeftShin, BoneId::kRightThigh, BoneId::kRightShin}) {
    const int j = static_cast<int>(id);
    axes[j] = (skeleton.tips[j] - skeleton.joints[j]).normalized();
  }
  return axes;
}

// How the bones of both surfaces turned.
class TurnWatch {
 public:
  TurnWatch(const BodyModel& subject, double fps)
      : parts_(PartsOf(subject)), axes_(LimbAxes(subject.skeleton)), fps_(fps) {}

  void Add(const std::vector<Vector3f>& estimate, const std::vector<Vector3f>& truth) {
    estimate_.push_back(parts_.Rotations(estimate));
    truth_.push_back(parts_.Rotations(truth));
  }

  void Summarize(nlohmann::json& row) const {
    row["jitter_rms_rad_s2"] = AngularJitter(estimate_, truth_, fps_);
    row["twist_rms_deg"] = TwistError(estimate_, truth_, axes_) * 180.0 / std::numbers::pi;
  }

 private:
  RigidParts parts_;
  std::vector<Vector3d> axes_;
  double fps_;
  std::vector<BoneRotations> estimate_, truth_;
};

void RecordQuantiles(const std::vector<double>& errors_m, RunRecord& record) {
  record.frames["l2_median_m"].push_back(Quantile(errors_m, 0.5));
  record.frames["l2_p95_m"].push_back(Quantile(errors_m, 0.95));
  record.frames["l2_p99_m"].push_back(Quantile(errors_m, 0.99));
}

std::vector<Vector3f> Chosen(const std::vector<Vector3f>& points, const std::vector<bool>& chosen) {
  std::vector<Vector3f> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (chosen[i]) kept.push_back(points[i]);
  }
  return kept;
}

// Distances of the estimate's visible vertices from the observed points (paper B, figure 6) and,
// not in the paper, from the true surface if there is one. Summed over every n-th frame.
class ReconstructionWatch {
 public:
  ReconstructionWatch(const SequenceReader& sequence, const EstimateReader& estimate, int every)
      : sequence_(sequence),
        camera_(sequence.info().camera),
        triangles_(estimate.rest_mesh().triangles),
        every_(every),
        zbuffer_(camera_) {}

  bool Measures(int frame) const { return every_ > 0 && frame % every_ == 0; }

  // `truth`: null where there is none.
  void Add(int frame, const std::vector<Vector3f>& estimate, const TriangleMesh* truth) {
    const DepthImage& seen = zbuffer_.Render(estimate, triangles_);
    const std::vector<Vector3f> visible =
        Chosen(estimate, VisiblePoints(estimate, seen, camera_, kVisibleWithin_m));
    CloudFromDepth(sequence_.ReadDepth(frame), camera_, 1, std::numeric_limits<float>::infinity(),
                   cloud_);
    if (!cloud_.points.empty())  // a frame without measurement has nothing to compare with
      Append(DistancesToPoints(visible, cloud_.points), to_observed_m_);
    if (truth != nullptr) Append(DistancesToSurface(visible, *truth), to_truth_m_);
  }

  void Summarize(nlohmann::json& row) const {
    Summarize("reconstruction", to_observed_m_, row);
    Summarize("surface_visible", to_truth_m_, row);
  }

 private:
  // Nothing where nothing was measured.
  static void Summarize(const std::string& name, const std::vector<double>& distances_m,
                        nlohmann::json& row) {
    if (distances_m.empty()) return;
    row[name + "_mean_m"] = Mean(distances_m);
    row[name + "_p95_m"] = Quantile(distances_m, 0.95);
  }

  static void Append(const std::vector<double>& distances, std::vector<double>& all) {
    all.insert(all.end(), distances.begin(), distances.end());
  }

  const SequenceReader& sequence_;
  PinholeCamera camera_;
  const std::vector<Triangle>& triangles_;
  int every_;
  ZBuffer zbuffer_;
  PointCloud cloud_;
  std::vector<double> to_observed_m_, to_truth_m_;
};

// Whether the estimate moves the sequence's own template.
bool MovesItsTemplate(const SequenceReader& sequence, const EstimateReader& estimate) {
  return sequence.info().subject &&
         estimate.rest_mesh().vertices.size() == sequence.subject().rest.vertices.size();
}

void RecordErrors(const std::vector<Vector3f>& estimated, const std::vector<Vector3f>& truth,
                  const std::vector<bool>& visible, RunRecord& record) {
  const std::vector<double> errors_m = VertexErrors(estimated, truth);
  const VertexErrorSummary error = Summarize(errors_m, visible);
  record.frames["l2_mean_m"].push_back(error.mean_m);
  record.frames["l2_max_m"].push_back(error.max_m);
  RecordQuantiles(errors_m, record);
  record.frames["l2_mean_visible_m"].push_back(error.visible_mean_m);
  record.frames["l2_max_visible_m"].push_back(error.visible_max_m);
  record.frames["l2_mean_hidden_m"].push_back(error.hidden_mean_m);
  record.frames["l2_max_hidden_m"].push_back(error.hidden_max_m);
}

void SummarizeErrors(RunRecord& record) {
  nlohmann::json& row = record.summary;
  row["diagonal_m"] = record.diagonal_m;
  // Over the frames in which there is such a vertex; absent if there is none in any frame.
  for (const char* key : {"l2_mean_m", "l2_mean_visible_m", "l2_mean_hidden_m"}) {
    const std::vector<double> means_m = PresentValues(record.frames.at(key));
    if (!means_m.empty()) row[key] = Mean(means_m);
  }
  for (const char* key : {"l2_max_m", "l2_max_visible_m", "l2_max_hidden_m"}) {
    const std::vector<double> maxima_m = PresentValues(record.frames.at(key));
    if (!maxima_m.empty()) row[key] = Maximum(maxima_m);
  }
  row["l2_mean_of_diagonal"] = Mean(record.frames.at("l2_mean_m")) / record.diagonal_m;
  row["l2_max_of_diagonal"] = Maximum(record.frames.at("l2_max_m")) / record.diagonal_m;
}

// Against the true surface.
void ScoreSurface(const SequenceReader& sequence, const EstimateReader& estimate,
                  ReconstructionWatch& reconstruction, RunRecord& record) {
  record.diagonal_m = BoundingBoxDiagonal(sequence.true_rest_mesh().vertices);
  TriangleMesh true_surface = sequence.true_rest_mesh();
  std::optional<TurnWatch> turns;
  if (MovesItsTemplate(sequence, estimate)) turns.emplace(sequence.subject(), sequence.info().fps);
  const RestCorrespondence correspondence(estimate.rest_mesh(), sequence.true_rest_mesh());
  const PinholeCamera& camera = sequence.info().camera;
  ZBuffer zbuffer(camera);
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    true_surface.vertices = sequence.ReadTrueVertices(frame);
    const std::vector<Vector3f> truth = correspondence.TruePositions(true_surface.vertices);
    const DepthImage& rendered = zbuffer.Render(true_surface.vertices, true_surface.triangles);
    const std::vector<Vector3f> estimated = estimate.ReadVertices(frame);
    if (turns) turns->Add(estimated, truth);
    if (reconstruction.Measures(frame)) reconstruction.Add(frame, estimated, &true_surface);
    RecordErrors(estimated, truth, VisiblePoints(truth, rendered, camera, kVisibleWithin_m),
                 record);
  }
  SummarizeErrors(record);
  if (turns) turns->Summarize(record.summary);
}

}  // namespace

void ScoreSurfaces(const SequenceReader& sequence, const EstimateReader& estimate,
                   int reconstruction_every, RunRecord& record) {
  ReconstructionWatch reconstruction(sequence, estimate, reconstruction_every);
  if (sequence.info().surface) {
    ScoreSurface(sequence, estimate, reconstruction, record);
  } else {
    for (int frame = 0; frame < sequence.info().frames; ++frame) {
      if (!reconstruction.Measures(frame)) continue;
      reconstruction.Add(frame, estimate.ReadVertices(frame), nullptr);
    }
  }
  reconstruction.Summarize(record.summary);
}

}  // namespace vitruvia
