// The joint detector of the skeleton-driven baseline: trained on images of a population, and tested
// on unseen people and poses.
#pragma once

#include <filesystem>

#include "learning/joints/learn_joints.h"
#include "synth/joint_examples/joint_examples.h"

namespace vitruvia {

// A file of configs/learning/joints*.json.
struct JointLearningSettings {
  JointExampleSettings examples;
  joints::ForestSettings forests;
  int test_images = 600;

  void Describe(Fields& fields);
};

joints::JointModel LearnJointModel(const JointLearningSettings& settings, int threads);

// Errors of a detector on test images: other people of the same distribution, in other poses, with
// lengths divided by the person's size (SizeOf).
struct DetectionErrors {
  int images = 0;
  std::array<double, kBodyPointCount> mean_m{};  // over the images in which the point is found
  std::array<double, kBodyPointCount> found{}, within_2_cm{}, within_5_cm{},
      within_10_cm{};  // shares of all images
};
DetectionErrors TestJointModel(const joints::JointModel& model,
                               const JointLearningSettings& settings, int threads);

}  // namespace vitruvia
