#include "learning/joints/learn_joints.h"

#include <mutex>

#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"

namespace vitruvia::joints {
namespace {

Vector3d Jitter(double deviation_m, RandomStream& random) {
  const double x = random.Normal(0.0, deviation_m), y = random.Normal(0.0, deviation_m);
  return {x, y, random.Normal(0.0, deviation_m)};
}

// Where the search for a point begins in a stage, but for the jitter: in the first one at the
// point's parent, later at the point itself.
const Vector3d& StartOf(const JointExample& example, int point, std::size_t stage) {
  if (stage > 0) return example.points[point];
  const int parent = BodyPoints()[point].parent;
  return parent < 0 ? example.centroid : example.points[parent];
}

std::vector<Sample> DrawSamples(const std::vector<JointExample>& examples,
                                const PinholeCamera& camera, const ForestSettings& settings,
                                std::size_t stage, int point, RandomStream& random) {
  std::vector<Sample> samples;
  samples.reserve(examples.size() * settings.starts_per_example);
  for (const JointExample& example : examples) {
    for (int k = 0; k < settings.starts_per_example; ++k) {
      const Vector3d start =
          StartOf(example, point, stage) + Jitter(settings.stages[stage].start_deviation_m, random);
      samples.push_back({&example.depth, FeaturePoint(camera, start.cast<float>()),
                         (example.points[point] - start).cast<float>()});
    }
  }
  return samples;
}

}  // namespace

void StageSettings::Describe(Fields& f) {
  f.Number("start_deviation_m", start_deviation_m,
           {.meaning = "standard deviation of the places that a stage's trees learn to start from, "
                       "round the point's parent in the first stage, round the point in later ones",
            .unit = "m",
            .min = 1e-4,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "the random tree walk has one stage"});
  f.Number("reach_m", reach_m,
           {.meaning = "how far from a place features look at most",
            .unit = "m",
            .min = 0.01,
            .max = 3.0,
            .origin = Origin::kGuessed,
            .source = "open trainers of Shotton et al. 2011: 0.4 m"});
}

void TreeSettings::Describe(Fields& f) {
  f.Integer("depth", depth,
            {.meaning = "splits from a tree's root to a leaf at most",
             .min = 1,
             .max = 24,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 20, with a hundred times the images"});
  f.Integer("least_samples", least_samples,
            {.meaning = "training samples in a leaf at least",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Integer("candidates", candidates,
            {.meaning = "features that are tried for a split",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 2000"});
  f.Integer("split_samples", split_samples,
            {.meaning = "training samples that a split's features are tried on at most",
             .min = 10,
             .max = 10000000,
             .origin = Origin::kGuessed});
}

void ForestSettings::Describe(Fields& f) {
  f.List("stages", stages, {.meaning = "steps of the walk to a point, in order"});
  f.Integer("trees", trees,
            {.meaning = "trees for each stage and point",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 3"});
  f.Integer("starts_per_example", starts_per_example,
            {.meaning = "places in each image from which a tree learns to find a point",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Section("tree", tree, {.meaning = "how a tree grows"});
  f.Integer("seed", seed, {.meaning = "seed of all random choices", .min = 0});
}

std::string ForestSettings::Problem() const {
  return stages.empty() ? "stages: expected one at least, got none" : "";
}

JointModel LearnJoints(const std::vector<JointExample>& examples, const PinholeCamera& camera,
                       const ForestSettings& settings, int threads) {
  Require(!examples.empty(), "LearnJoints: no examples");
  JointModel model;
  for (const StageSettings& stage : settings.stages) {
    JointStage& learnt = model.stages.emplace_back();
    learnt.start_deviation_m = stage.start_deviation_m;
    for (Forest& forest : learnt.forests) forest.resize(static_cast<std::size_t>(settings.trees));
  }
  const int per_stage = kBodyPointCount * settings.trees;
  const int count = per_stage * static_cast<int>(settings.stages.size());
  Progress progress("trees", count);
  std::mutex progress_mutex;
  WorkerTeam team(threads);
  team.For(count, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      ThrowIfInterrupted();
      const auto stage = static_cast<std::size_t>(i / per_stage);
      const int point = i % per_stage / settings.trees, tree = i % settings.trees;
      RandomStream random(
          static_cast<std::uint64_t>(settings.seed),
          fmt::format("stage {} {} tree {}", stage, BodyPoints()[point].name, tree));
      std::vector<Sample> samples = DrawSamples(examples, camera, settings, stage, point, random);
      model.stages[stage].forests[point][static_cast<std::size_t>(tree)] =
          GrowTree(samples, settings.tree, settings.stages[stage].reach_m, random);
      const std::lock_guard lock(progress_mutex);
      progress.Advance();
    }
  });
  return model;
}

}  // namespace vitruvia::joints
