#include "methods/gmm_articulated/mixture_term.h"

#include <gtest/gtest.h>

#include "fitting/state_step.h"
#include "math/rigid.h"
#include "support/body_states.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::gmm_articulated {
namespace {

using articulated::kParameterCount;
using Parameters = Eigen::VectorXd;

class MixtureTermTest : public testing::Test {
 protected:
  MixtureTermTest() : shaped_(RigidShape(body_, 2000)) {}

  DepthImage Depth(const BodyState& state) const {
    articulated::ModelView view(shaped_, camera_);
    view.Look(WorldFromRest(shaped_, state));
    return view.depth();
  }

  // Rounds from a state; `each` sees the term after each.
  template <class Each>
  BodyState Rounds(const DepthImage& depth, BodyState state, int rounds, const Each& each) const {
    MixtureTerm term(shaped_, camera_, settings_);
    PointCloud cloud;
    CloudFromDepth(depth, camera_, settings_.common.stride_px, 10.0f, cloud);
    term.Observe({&depth, &cloud});
    articulated::MovingBones bones(shaped_);
    bones.Set(state);
    term.Begin(bones);
    WorkerTeam team(1);
    articulated::Clock clock;
    for (int round = 0; round < rounds; ++round) {
      bones.Set(state);
      bones.Differentiate();
      articulated::PoseSystem system;
      term.AddRows(bones, 0.0, team, clock, system);
      system.Reduce(bones.twists());
      Eigen::MatrixXd hessian = system.hessian();
      hessian.diagonal().array() += 100.0;
      state = Moved(
          state, SolveWithinLimits(hessian, system.gradient(), state.angles_deg, kParameterCount));
      each(term);
    }
    return state;
  }

  const BodyModel body_ = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  const ShapedBody shaped_;
  const PinholeCamera camera_;
  Settings settings_;
};

TEST_F(MixtureTermTest, CleanDataHoldTheTruth) {
  const BodyState truth = RandomState(10.0, 3);
  const BodyState reached = Rounds(Depth(truth), truth, 10, [](const MixtureTerm&) {});
  const auto joints = [&](const BodyState& state) {
    return PosedJoints(shaped_.skeleton, WorldFromRest(shaped_, state));
  };
  const auto before = joints(truth), after = joints(reached);
  double sum = 0.0;
  for (int b = 0; b < kBoneCount; ++b) sum += (after[b] - before[b]).norm();
  EXPECT_LT(sum / kBoneCount, 0.01);
}

TEST_F(MixtureTermTest, WidthFallsWhileTheBodyIsDrawnToTheData) {
  BodyState start = FacingState();
  start.pelvis_position += Vector3d(0.03, -0.02, 0.03);
  double last = settings_.first_sigma_m;
  const BodyState reached = Rounds(Depth(FacingState()), start, 12, [&](const MixtureTerm& term) {
    EXPECT_LE(term.sigma_m(), last * (1.0 + 1e-6));
    last = term.sigma_m();
  });
  EXPECT_LT(last, 0.5 * settings_.first_sigma_m);
  EXPECT_LT((reached.pelvis_position - FacingState().pelvis_position).norm(), 0.01);
}

}  // namespace
}  // namespace vitruvia::gmm_articulated
