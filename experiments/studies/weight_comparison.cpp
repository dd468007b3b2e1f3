#include "experiments/studies/weight_comparison.h"

#include <algorithm>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr double kMmPerM = 1000.0;
constexpr double kPercentile = 0.95;

struct Difference {
  double mean = 0.0, p95 = 0.0;
};

Difference Compare(const SkinWeights& one, const SkinWeights& other) {
  const Eigen::MatrixXf difference = Dense(one, kBoneCount) - Dense(other, kBoneCount);
  std::vector<double> shares(one.size());
  double sum = 0.0;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    shares[v] = 0.5 * difference.row(static_cast<Eigen::Index>(v)).cwiseAbs().sum();
    sum += shares[v];
  }
  const auto percentile = shares.begin() + static_cast<std::ptrdiff_t>(
                                               kPercentile * static_cast<double>(shares.size()));
  std::nth_element(shares.begin(), percentile, shares.end());
  return {sum / static_cast<double>(shares.size()), *percentile};
}

skinning::Examples ExamplesOf(const BodyDatabase& database, const PoseExamples& examples) {
  const auto subject =
      std::find_if(database.subjects.begin(), database.subjects.end(),
                   [&](const DatabaseSubject& s) { return s.name == examples.subject; });
  Require(subject != database.subjects.end(), "ExamplesOf: no subject {}", examples.subject);
  return {subject->vertices, examples.poses};
}

}  // namespace

WeightComparison CompareWeights(const BodyDatabase& database, const skinning::Settings& settings) {
  WeightComparison comparison;
  std::vector<SkinWeights> weights;
  for (const PoseExamples& examples : database.examples) {
    skinning::Decomposition learnt = LearnWeights(database, examples, settings);
    comparison.names.push_back(examples.subject);
    comparison.alternations.push_back(static_cast<int>(learnt.alternations.size()));
    comparison.own_rmse_m.push_back(learnt.rmse_m);
    weights.push_back(std::move(learnt.weights));
  }
  comparison.names.emplace_back("rig");
  weights.push_back(database.reference.weights);
  for (const SkinWeights& of_one : weights) {
    auto& rmse_m = comparison.swapped_rmse_m.emplace_back();
    auto& mean = comparison.difference_mean.emplace_back();
    auto& p95 = comparison.difference_p95.emplace_back();
    for (std::size_t other = 0; other < database.examples.size(); ++other) {
      rmse_m.push_back(skinning::FitTransforms(ExamplesOf(database, database.examples[other]),
                                               of_one, kBoneCount, settings.threads)
                           .rmse_m);
      const Difference difference = Compare(of_one, weights[other]);
      mean.push_back(difference.mean);
      p95.push_back(difference.p95);
    }
  }
  return comparison;
}

Json ToJson(const WeightComparison& c) {
  return {{"names", c.names},
          {"alternations", c.alternations},
          {"own_rmse_m", c.own_rmse_m},
          {"swapped_rmse_m", c.swapped_rmse_m},
          {"difference_mean", c.difference_mean},
          {"difference_p95", c.difference_p95}};
}

void Print(const WeightComparison& c) {
  fmt::print("{:<8} {:>13} {:>10}\n", "subject", "alternations", "RMSE mm");
  for (std::size_t s = 0; s < c.own_rmse_m.size(); ++s) {
    fmt::print("{:<8} {:>13} {:>10.3f}\n", c.names[s], c.alternations[s],
               kMmPerM * c.own_rmse_m[s]);
  }
  fmt::print("{:<8} {:<8} {:>10} {:>17} {:>16}\n", "weights", "used on", "RMSE mm",
             "difference mean", "difference p95");
  for (std::size_t one = 0; one < c.swapped_rmse_m.size(); ++one) {
    for (std::size_t other = 0; other < c.swapped_rmse_m[one].size(); ++other) {
      fmt::print("{:<8} {:<8} {:>10.3f} {:>17.4f} {:>16.4f}\n", c.names[one], c.names[other],
                 kMmPerM * c.swapped_rmse_m[one][other], c.difference_mean[one][other],
                 c.difference_p95[one][other]);
    }
  }
}

}  // namespace vitruvia
