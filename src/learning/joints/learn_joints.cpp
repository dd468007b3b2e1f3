#include "learning/joints/learn_joints.h"

#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"

namespace vitruvia::joints {
namespace {

Vector3d Jitter(double deviation_m, RandomStream& random) {
  const double x = random.Normal(0.0, deviation_m), y = random.Normal(0.0, deviation_m);
  return {x, y, random.Normal(0.0, deviation_m)};
}

// Which images each tree learns from; every image is left out by one tree at least.
std::vector<std::vector<char>> DrawImages(std::size_t images, const ForestSettings& settings,
                                          RandomStream& random) {
  std::vector<std::vector<char>> takes(settings.trees, std::vector<char>(images));
  for (std::size_t i = 0; i < images; ++i) {
    for (std::vector<char>& tree : takes) tree[i] = random.Uniform() < settings.image_share ? 1 : 0;
    takes[random.Index(settings.trees)][i] = 0;
  }
  return takes;
}

// Learns the forests of one point from where its search begins in each image.
class PointLearner {
 public:
  PointLearner(const std::vector<JointExample>& examples, const PinholeCamera& camera,
               const ForestSettings& settings, int point, std::vector<Vector3d> starts)
      : examples_(examples),
        camera_(camera),
        settings_(settings),
        point_(point),
        places_(std::move(starts)) {}

  // Moves the places to where trees that have not seen the image lead.
  Forest LearnStage(std::size_t stage, WorkerTeam& team) {
    const std::string name = fmt::format("stage {} {}", stage, BodyPoints()[point_].name);
    RandomStream image_random(static_cast<std::uint64_t>(settings_.seed), name);
    const auto takes = DrawImages(examples_.size(), settings_, image_random);
    Forest forest(static_cast<std::size_t>(settings_.trees));
    team.For(settings_.trees, 1, [&](int begin, int end) {
      for (int t = begin; t < end; ++t) {
        ThrowIfInterrupted();
        RandomStream random(static_cast<std::uint64_t>(settings_.seed),
                            fmt::format("{} tree {}", name, t));
        std::vector<Sample> samples = DrawSamples(stage, takes[t], random);
        if (samples.empty()) throw DataError("joint examples: too few for a tree");
        forest[t] = GrowTree(samples, settings_.tree, settings_.stages[stage].reach_m, random);
      }
    });
    team.For(static_cast<int>(examples_.size()), [&](int begin, int end) {
      for (int i = begin; i < end; ++i) MovePlace(forest, takes, static_cast<std::size_t>(i));
    });
    return forest;
  }

  std::vector<Vector3d> TakePlaces() && { return std::move(places_); }

 private:
  std::vector<Sample> DrawSamples(std::size_t stage, const std::vector<char>& takes,
                                  RandomStream& random) const {
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < examples_.size(); ++i) {
      if (takes[i] == 0) continue;
      for (int k = 0; k < settings_.starts_per_image; ++k) {
        const Vector3d start = places_[i] + Jitter(settings_.stages[stage].jitter_m, random);
        samples.push_back({&examples_[i].depth, FeaturePoint(camera_, start.cast<float>()),
                           (examples_[i].points[point_] - start).cast<float>()});
      }
    }
    return samples;
  }

  void MovePlace(const Forest& forest, const std::vector<std::vector<char>>& takes,
                 std::size_t image) {
    const FeaturePoint place(camera_, places_[image].cast<float>());
    Vector3f sum = Vector3f::Zero();
    int count = 0;
    for (std::size_t t = 0; t < forest.size(); ++t) {
      if (takes[t][image] != 0) continue;
      sum += forest[t].Offset(examples_[image].depth, place);
      ++count;
    }
    places_[image] += (sum / static_cast<float>(count)).cast<double>();
  }

  const std::vector<JointExample>& examples_;
  const PinholeCamera& camera_;
  const ForestSettings& settings_;
  int point_;
  std::vector<Vector3d> places_;  // one for each image
};

}  // namespace

void StageSettings::Describe(Fields& f) {
  f.Number("jitter_m", jitter_m,
           {.meaning = "standard deviation of the places that a stage's trees learn to start from, "
                       "round those that earlier stages reach",
            .unit = "m",
            .min = 0.0,
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
  f.Number("image_share", image_share,
           {.meaning = "share of the images that a tree learns from; the others say what the next "
                       "stage has to learn",
            .min = 0.05,
            .max = 0.95,
            .origin = Origin::kGuessed});
  f.Integer("starts_per_image", starts_per_image,
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
  for (const StageSettings& stage : settings.stages)
    model.stages.emplace_back().jitter_m = stage.jitter_m;
  WorkerTeam team(threads);
  Progress progress("forests", kBodyPointCount * static_cast<int>(settings.stages.size()));
  std::array<std::vector<Vector3d>, kBodyPointCount> reached;  // by each point, in each image
  for (int point = 0; point < kBodyPointCount; ++point) {
    const int parent = BodyPoints()[point].parent;
    std::vector<Vector3d> starts;
    if (parent >= 0) {
      starts = reached[parent];
    } else {
      for (const JointExample& example : examples) starts.push_back(example.centroid);
    }
    PointLearner learner(examples, camera, settings, point, std::move(starts));
    for (std::size_t stage = 0; stage < settings.stages.size(); ++stage) {
      model.stages[stage].forests[point] = learner.LearnStage(stage, team);
      progress.Advance();
    }
    reached[point] = std::move(learner).TakePlaces();
  }
  return model;
}

}  // namespace vitruvia::joints
