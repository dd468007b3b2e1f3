#include "scoring/observation_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "body/skeleton.h"
#include "geometry/point_cloud.h"
#include "math/rigid.h"
#include "math/statistics.h"
#include "metrics/observation_error.h"
#include "metrics/reconstruction_error.h"
#include "scoring/score.h"

namespace vitruvia {
namespace {

constexpr int kMostPoints = 3000;  // of a frame, held against the surface

void Append(const std::vector<double>& distances, std::vector<double>& all) {
  all.insert(all.end(), distances.begin(), distances.end());
}

void SummarizeDistances(const std::string& name, const std::vector<double>& distances_m,
                        nlohmann::json& row) {
  if (distances_m.empty()) return;
  row[name + "_mean_m"] = Mean(distances_m);
  row[name + "_median_m"] = Quantile(distances_m, 0.5);
  row[name + "_p95_m"] = Quantile(distances_m, 0.95);
}

void SummarizeMean(const char* key, RunRecord& record) {
  const std::vector<double> values = PresentValues(record.frames.at(key));
  if (!values.empty()) record.summary[key] = Mean(values);
}

// The estimate against the sequence's own camera.
void ScoreFit(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record) {
  const PinholeCamera& camera = sequence.info().camera;
  ZBuffer zbuffer(camera);
  TriangleMesh surface = estimate.rest_mesh();
  std::vector<double> points_m, model_m;
  for (int frame = 0; frame < sequence.info().frames; ++frame) {
    surface.vertices = estimate.ReadVertices(frame);
    const ObservationError error = CompareWithObservation(surface, sequence.ReadDepth(frame),
                                                          sequence.ReadDepthWithRoom(frame), camera,
                                                          kVisibleWithin_m, kMostPoints, zbuffer);
    Append(error.points_to_model_m, points_m);
    Append(error.model_to_points_m, model_m);
    const double points_mean = MeanOrAbsent(error.points_to_model_m);
    const double model_mean = MeanOrAbsent(error.model_to_points_m);
    record.frames["fit_m"].push_back(0.5 * (points_mean + model_mean));
    record.frames["fit_points_mean_m"].push_back(points_mean);
    record.frames["fit_model_mean_m"].push_back(model_mean);
    record.frames["silhouette_overlap"].push_back(error.silhouette_overlap);
    record.frames["points_unexplained"].push_back(error.points_unexplained);
    record.frames["model_in_front"].push_back(error.model_in_front);
  }
  SummarizeDistances("fit_points", points_m, record.summary);
  SummarizeDistances("fit_model", model_m, record.summary);
  for (const char* key : {"fit_m", "silhouette_overlap", "points_unexplained", "model_in_front"})
    SummarizeMean(key, record);
}

// The estimate against what other cameras saw and the sequence's own did not.
void ScoreViews(const SequenceReader& sequence, const EstimateReader& estimate, RunRecord& record) {
  const SequenceInfo& info = sequence.info();
  if (info.views.empty()) return;
  TriangleMesh surface = estimate.rest_mesh();
  std::vector<double> all_m;
  PointCloud cloud;
  for (int frame = 0; frame < info.frames; ++frame) {
    surface.vertices = estimate.ReadVertices(frame);
    const DepthImage seen = sequence.ReadDepthWithRoom(frame);
    std::vector<double> of_frame_m;
    for (std::size_t k = 0; k < info.views.size(); ++k) {
      const OtherView& view = info.views[k];
      CloudFromDepth(sequence.ReadViewDepth(static_cast<int>(k), frame), view.camera, 2,
                     std::numeric_limits<float>::infinity(), cloud);
      const Rigidf camera_from_view = Inverse(view.view_from_camera).Cast<float>();
      for (Vector3f& point : cloud.points) point = camera_from_view * point;
      Append(DistancesToSurface(PointsUnseen(cloud.points, seen, info.camera, kUnexplainedAbove_m),
                                surface),
             of_frame_m);
    }
    record.frames["view_mean_m"].push_back(MeanOrAbsent(of_frame_m));
    Append(of_frame_m, all_m);
  }
  SummarizeDistances("view", all_m, record.summary);
}

constexpr std::array kLeftLimbs{BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kLeftThigh,
                                BoneId::kLeftShin};

// From a limb's joint to the next one's.
std::vector<double> LimbLengths(const EstimateReader& estimate, int bone) {
  std::vector<double> lengths;
  for (const FrameEstimate& frame : estimate.frames()) {
    const auto at = static_cast<std::size_t>(bone);  // the next bone of a limb follows its own
    lengths.push_back((frame.joints[at + 1] - frame.joints[at]).norm());
  }
  return lengths;
}

void ScoreLimbs(const EstimateReader& estimate, nlohmann::json& row) {
  double change = 0.0, asymmetry = 0.0;
  for (const BoneId left : kLeftLimbs) {
    const int bone = static_cast<int>(left);
    const int mirror = Bones()[static_cast<std::size_t>(bone)].mirror;
    std::array<double, 2> medians{};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::vector<double> lengths = LimbLengths(estimate, side == 0 ? bone : mirror);
      medians[side] = Quantile(lengths, 0.5);
      if (medians[side] == 0.0) return;  // the method finds no joints
      for (const double length : lengths)
        change = std::max(change, std::abs(length / medians[side] - 1.0));
    }
    asymmetry =
        std::max(asymmetry, 2.0 * std::abs(medians[0] - medians[1]) / (medians[0] + medians[1]));
  }
  row["limb_length_change"] = change;
  row["limb_asymmetry"] = asymmetry;
}

// How well the misfit orders the frames by a true error, where that is known.
void CompareWithTruth(const char* error, const char* error_of_own_surfaces, const char* key,
                      RunRecord& record) {
  const auto corresponding = record.frames.find(error);
  const auto true_error = corresponding != record.frames.end()
                              ? corresponding
                              : record.frames.find(error_of_own_surfaces);
  if (true_error == record.frames.end()) return;
  std::vector<double> misfits, errors;
  const std::vector<double>& fit = record.frames.at("fit_m");
  for (std::size_t i = 0; i < fit.size(); ++i) {
    if (std::isnan(fit[i]) || std::isnan(true_error->second[i])) continue;
    misfits.push_back(fit[i]);
    errors.push_back(true_error->second[i]);
  }
  const double correlation = RankCorrelation(misfits, errors);
  if (!std::isnan(correlation)) record.summary[key] = correlation;
}

}  // namespace

void ScoreObservation(const SequenceReader& sequence, const EstimateReader& estimate,
                      RunRecord& record) {
  ScoreFit(sequence, estimate, record);
  ScoreViews(sequence, estimate, record);
  ScoreLimbs(estimate, record.summary);
  CompareWithTruth("l2_mean_visible_m", "two_way_visible_mean_m", "fit_rank_correlation", record);
  CompareWithTruth("l2_mean_m", "two_way_mean_m", "fit_rank_correlation_whole", record);
}

}  // namespace vitruvia
