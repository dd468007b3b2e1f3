// Finds the best of many pose hypotheses for a frame, for any kind of pose.
#pragma once

#include <algorithm>
#include <concepts>
#include <vector>

#include "math/vector.h"
#include "tracking/agreement.h"

namespace vitruvia {

// Rotations in the camera frame that a search applies to a known pose: about the vertical axis in
// steps of 45 degrees, upright and upside down.
std::vector<Matrix3<double>> HypothesisRotations();

// Interface that a method implements so that its poses can be searched.
//   Compare(pose)  the agreement of the frame with the model in that pose, without iterations
//   Refine(pose)   the result of iterations from that pose; its member `agreement` belongs to the
//                  pose that they reached
template <class Tester, class Pose>
concept PoseTester = requires(Tester& tester, const Pose& pose) {
  { tester.Compare(pose) } -> std::convertible_to<Agreement>;
  { tester.Refine(pose).agreement } -> std::convertible_to<Agreement>;
};

// Compares all hypotheses, at least one, refines the num_refined with the highest scores and
// returns the refined result with the highest score. Among equal scores the first hypothesis wins.
template <class Pose, PoseTester<Pose> Tester>
auto FindBestPose(const std::vector<Pose>& hypotheses, int num_refined, Tester& tester) {
  struct Scored {
    const Pose* pose;
    double score;
  };
  std::vector<Scored> scored;
  for (const Pose& pose : hypotheses) scored.push_back({&pose, tester.Compare(pose).score()});
  std::stable_sort(scored.begin(), scored.end(),
                   [](const Scored& a, const Scored& b) { return a.score > b.score; });
  scored.resize(std::min(scored.size(), static_cast<std::size_t>(num_refined)));

  auto best = tester.Refine(*scored.front().pose);
  for (std::size_t k = 1; k < scored.size(); ++k) {
    auto refined = tester.Refine(*scored[k].pose);
    if (refined.agreement.score() > best.agreement.score()) best = std::move(refined);
  }
  return best;
}

}  // namespace vitruvia
