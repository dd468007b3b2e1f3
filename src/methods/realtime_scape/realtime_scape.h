// Realtime SCAPE (paper A, algorithm 1): LBS pose of 17 bones by linearised least squares.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "methods/realtime_scape/model.h"
#include "methods/realtime_scape/recovery.h"
#include "methods/realtime_scape/settings.h"
#include "solver/block_normal_equations.h"
#include "tracking/tracker.h"

namespace vitruvia::realtime_scape {

class RealtimeScape final : public Tracker {
 public:
  explicit RealtimeScape(const Settings& settings);
  ~RealtimeScape() override;

  void Start(const Subject& subject, const PinholeCamera& camera) override;
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  // Everything that depends on the subject and the camera.
  struct Session;
  struct TriedPose;
  // Largest step of any bone in one iteration.
  struct Step {
    double rotation_rad = 0.0, translation_m = 0.0;
  };

  bool BeginFrame(const DepthFrame& frame);
  void Place();
  void Predict();
  void Render();
  void Classify(const DepthFrame& frame);
  void BuildCandidates();
  void FindPairs();
  std::array<double, 4> AddTerms(BlockNormalEquations& equations) const;
  void Assemble();
  void Solve();
  Step Update();
  void WatchEnergy();
  bool IsSmall(const Step& step) const;
  bool Iterate(const DepthFrame& frame, int limit);
  Agreement CurrentAgreement() const;
  void StartFrom(const BodyPose& pose);
  Agreement Compare(const DepthFrame& frame, const BodyPose& pose);
  BodyPose OnCloud(BodyPose pose);
  std::vector<TriedPose> BestHypotheses(const DepthFrame& frame, const BodyPose& latest);
  void TryOtherPoses(const DepthFrame& frame);
  void EndFrame();
  TrackResult Result(bool stopped_small, int iterations);

  Settings settings_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::realtime_scape
