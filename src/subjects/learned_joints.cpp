#include "subjects/learned_joints.h"

#include <algorithm>

namespace vitruvia {
namespace {

constexpr double kFarthest_m = 10.0;

DepthImage WholeImage(const joints::CroppedDepth& cropped, const PinholeCamera& camera) {
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) depth(u, v) = cropped.At(u, v);
  }
  return depth;
}

}  // namespace

void JointLearningSettings::Describe(Fields& f) {
  f.Section("examples", examples, {.meaning = "the depth images that are learnt from"});
  f.Section("forests", forests, {.meaning = "the forests that find the joints"});
  f.Integer("test_images", test_images,
            {.meaning = "number of images of other people that the detector is tried on",
             .min = 1,
             .max = 1000000});
}

joints::JointModel LearnJointModel(const JointLearningSettings& settings, int threads) {
  return joints::LearnJoints(MakeJointExamples(settings.examples, threads),
                             settings.examples.camera, settings.forests, threads);
}

DetectionErrors TestJointModel(const joints::JointModel& model,
                               const JointLearningSettings& settings, int threads) {
  JointExampleSettings others = settings.examples;
  others.seed += 1;
  others.population.seed += 1;
  others.images = settings.test_images;
  const joints::JointDetector detector(model, joints::VoteSettings());
  DetectionErrors errors;
  errors.images = others.images;
  const double share = 1.0 / others.images;
  for (const joints::JointExample& example : MakeJointExamples(others, threads)) {
    const joints::DetectedPoints found =
        detector.Detect(WholeImage(example.depth, others.camera), others.camera, kFarthest_m, 1.0);
    for (int p = 0; p < kBodyPointCount; ++p) {
      if (!found[p]) continue;
      const double error_m = (*found[p] - example.points[p]).norm();
      errors.found[p] += share;
      errors.within_2_cm[p] += error_m <= 0.02 ? share : 0.0;
      errors.mean_m[p] += share * error_m;
      errors.within_5_cm[p] += error_m <= 0.05 ? share : 0.0;
      errors.within_10_cm[p] += error_m <= 0.10 ? share : 0.0;
    }
  }
  for (int p = 0; p < kBodyPointCount; ++p) errors.mean_m[p] /= std::max(share, errors.found[p]);
  return errors;
}

}  // namespace vitruvia
