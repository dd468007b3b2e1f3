#include "learning/joints/learn_joints.h"

#include <mutex>

#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"

namespace vitruvia::joints {
namespace {

std::vector<TrainingPixel> DrawPixels(const std::vector<JointExample>& examples,
                                      const PinholeCamera& camera, const ForestSettings& settings,
                                      RandomStream& random) {
  std::vector<TrainingPixel> pixels;
  for (const JointExample& example : examples) {
    if (example.pixels.empty()) continue;
    for (int k = 0; k < settings.pixels_per_image; ++k) {
      const LabelledPixel& pixel = example.pixels[random.Index(example.pixels.size())];
      const float z = example.depth.At(pixel.u, pixel.v);
      if (z == 0.0f) continue;
      const Vector3f position = camera.Unproject<float>(pixel.u, pixel.v, z);
      pixels.push_back(
          {&example.depth, FeaturePoint(camera, position), position, pixel.bone, &example.points});
    }
  }
  return pixels;
}

// Places round a point, normally distributed.
std::vector<TrainingPixel> DrawStarts(const std::vector<JointExample>& examples,
                                      const PinholeCamera& camera, int point,
                                      const WalkSettings& settings, RandomStream& random) {
  std::vector<TrainingPixel> starts;
  for (const JointExample& example : examples) {
    if (example.pixels.empty()) continue;
    for (int k = 0; k < settings.starts_per_image; ++k) {
      Vector3f position = example.points[point].cast<float>();
      for (int axis = 0; axis < 3; ++axis)
        position[axis] += static_cast<float>(random.Normal(0.0, settings.deviation_m));
      starts.push_back(
          {&example.depth, FeaturePoint(camera, position), position, 0, &example.points});
    }
  }
  return starts;
}

}  // namespace

void TreeSettings::Describe(Fields& f) {
  f.Integer("depth", depth,
            {.meaning = "maximum number of splits from a tree's root to a leaf",
             .min = 1,
             .max = 30,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 20, with a hundred times the images"});
  f.Integer("least_pixels", least_pixels,
            {.meaning = "minimum number of training pixels in a leaf",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Integer("candidates", candidates,
            {.meaning = "features that are tried for a split",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 2000"});
  f.Integer("split_pixels", split_pixels,
            {.meaning = "maximum number of training pixels on which a split's features are tested",
             .min = 10,
             .max = 10000000,
             .origin = Origin::kGuessed});
  f.Number("reach_m", reach_m,
           {.meaning = "maximum distance of a feature's offset from its pixel",
            .unit = "m",
            .min = 0.01,
            .max = 3.0,
            .origin = Origin::kGuessed,
            .source = "open trainers of Shotton et al. 2011: 0.4 m"});
}

void WalkSettings::Describe(Fields& f) {
  f.Integer("trees", trees,
            {.meaning = "number of walk trees of each joint; 0: the votes' mode is the joint",
             .min = 0,
             .max = 100,
             .origin = Origin::kGuessed,
             .source = "Jung et al. 2015: 1"});
  f.Integer("starts_per_image", starts_per_image,
            {.meaning = "places round a joint in each image that a walk tree learns from",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed});
  f.Number("deviation_m", deviation_m,
           {.meaning = "standard deviation of those places from the joint, along each axis",
            .unit = "m",
            .min = 1e-3,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Section("tree", tree, {.meaning = "how a walk tree grows"});
}

void ForestSettings::Describe(Fields& f) {
  f.Integer("trees", trees,
            {.meaning = "number of trees",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 3"});
  f.Integer("pixels_per_image", pixels_per_image,
            {.meaning = "pixels of each image that a tree learns from",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "Shotton et al. 2011: 2000"});
  f.Section("tree", tree, {.meaning = "how a tree grows"});
  f.Section("walks", walks, {.meaning = "the trees that lead from the votes to a joint"});
  f.Integer("seed", seed, {.meaning = "seed of all random choices", .min = 0});
}

JointModel LearnJoints(const std::vector<JointExample>& examples, const PinholeCamera& camera,
                       const ForestSettings& settings, int threads) {
  JointModel model;
  model.trees.resize(static_cast<std::size_t>(settings.trees));
  for (auto& walk : model.walks) walk.resize(static_cast<std::size_t>(settings.walks.trees));
  const int count = settings.trees + kBodyPointCount * settings.walks.trees;
  Progress progress("trees", count);
  std::mutex progress_mutex;
  const auto seed = static_cast<std::uint64_t>(settings.seed);
  const auto grow_tree = [&](int t) {
    RandomStream random(seed, fmt::format("tree {}", t));
    std::vector<TrainingPixel> pixels = DrawPixels(examples, camera, settings, random);
    if (pixels.empty()) throw DataError("joint examples: no image shows a part of a body");
    model.trees[static_cast<std::size_t>(t)] = GrowTree(pixels, settings.tree, random);
  };
  const auto grow_walk_tree = [&](int point, int t) {
    RandomStream random(seed, fmt::format("walk tree {} of point {}", t, point));
    std::vector<TrainingPixel> starts = DrawStarts(examples, camera, point, settings.walks, random);
    if (starts.empty()) throw DataError("joint examples: no image shows a part of a body");
    model.walks[point][static_cast<std::size_t>(t)] =
        GrowWalkTree(starts, point, settings.walks.tree, random);
  };
  WorkerTeam(threads).For(count, 1, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      ThrowIfInterrupted();
      if (t < settings.trees) {
        grow_tree(t);
      } else {
        grow_walk_tree((t - settings.trees) % kBodyPointCount,
                       (t - settings.trees) / kBodyPointCount);
      }
      const std::lock_guard lock(progress_mutex);
      progress.Advance();
    }
  });
  return model;
}

}  // namespace vitruvia::joints
