// The tracker as a whole, on depth drawn by the z-buffer, and the solver of its pose step.
#include "methods/dynamic/dynamic.h"

#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dynamic_fixtures.h"
#include "math/rigid.h"
#include "methods/dynamic/energy_terms.h"
#include "methods/dynamic/pose_solver.h"
#include "support/arm_stage.h"

namespace vitruvia::dynamic {
namespace {

struct FrameStage : ArmStage {
  FrameStage() : ArmStage(2, SkinDualQuaternion, CameraFromStart()) {}
};

TEST(Dynamic, FollowsAMovingArmInEveryMode) {
  for (const Mode mode : {Mode::kFull, Mode::kShapeMatch, Mode::kSmoothBind, Mode::kRigid}) {
    FrameStage stage;
    Settings settings;
    settings.mode = mode;
    Dynamic tracker(settings, HumanSkeleton());
    tracker.Start(stage.body, stage.camera);
    for (int i = 0; i <= 15; ++i) {
      const double angle = 0.04 * i;  // 1.2 rad/s
      const TrackResult result = tracker.TrackFrame(stage.Frame(i, angle));
      EXPECT_FALSE(IsFailure(result.outcome)) << result.message;
      EXPECT_EQ(result.vertices.size(), stage.body.rest.vertices.size());
      EXPECT_LT(stage.MeanError(result, angle), mode == Mode::kRigid ? 0.02 : 0.01)
          << "mode " << static_cast<int>(mode) << ", frame " << i;
    }
  }
}

TEST(Dynamic, FollowsOnASubsetOfVerticesAndPixels) {
  FrameStage stage;
  Settings settings;
  settings.association.pose_vertex_stride = 4;
  settings.association.pose_pixel_stride = 2;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  for (int i = 0; i <= 10; ++i) {
    const TrackResult result = tracker.TrackFrame(stage.Frame(i, 0.04 * i));
    EXPECT_LT(stage.MeanError(result, 0.04 * i), 0.015) << "frame " << i;
  }
}

TEST(Dynamic, CarriesPoseAndShapeOverAnEmptyFrameAndGoesOn) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  const TrackResult empty = tracker.TrackFrame({1, 1 / 30.0, DepthImage(320, 240)});
  EXPECT_EQ(empty.outcome, Outcome::kNoData);
  EXPECT_EQ(empty.iterations, 0);
  EXPECT_EQ(empty.vertices, before.vertices);
  EXPECT_GT(before.condition, 1.0);
  EXPECT_EQ(empty.condition, -1.0);  // nothing was solved
  const TrackResult after = tracker.TrackFrame(stage.Frame(2, 0.0));
  EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
  EXPECT_LT(stage.MeanError(after, 0.0), 0.01);
}

DepthFrame FrameOfPoints(int count) {
  DepthFrame frame{1, 1 / 30.0, DepthImage(320, 240)};
  for (int i = 0; i < count; ++i) frame.depth(150 + i, 120) = 2.8f;
  return frame;
}

TEST(Dynamic, SaysLostWhenAFrameHasTooFewPoints) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  const TrackResult first = tracker.TrackFrame(FrameOfPoints(1));
  EXPECT_EQ(first.outcome, Outcome::kLost);
  EXPECT_THAT(first.message, testing::HasSubstr("1 measured pixel, too few to fix a pose"));
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  EXPECT_FALSE(IsFailure(before.outcome)) << before.message;
  EXPECT_LT(stage.MeanError(before, 0.0), 0.01);
  const TrackResult few = tracker.TrackFrame(FrameOfPoints(kLeastPoints - 1));
  EXPECT_EQ(few.outcome, Outcome::kLost);
  EXPECT_EQ(few.vertices, before.vertices);
  EXPECT_GT(tracker.TrackFrame(FrameOfPoints(kLeastPoints)).iterations, 0);
}

TEST(Dynamic, FitsFramesOfAsFewPointsAsItsSettingSays) {
  FrameStage stage;
  Settings settings;
  settings.least_points = 1;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  tracker.TrackFrame(stage.Frame(0, 0.0));
  EXPECT_GT(tracker.TrackFrame(FrameOfPoints(1)).iterations, 0);
}

// The body turns by 180 degrees about its own vertical from one frame to the next.
double ErrorAfterAHalfTurn(double margin_m) {
  const Rigidd half_turn{Vector3d(-1, 1, -1).asDiagonal().toDenseMatrix(), Vector3d::Zero()};
  FrameStage first;
  ArmStage second{2, SkinDualQuaternion, CameraFromStart() * half_turn};
  Settings settings;
  settings.facing.margin_m = margin_m;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(first.body, first.camera);
  for (int i = 0; i < 4; ++i) tracker.TrackFrame(first.Frame(i, 0.2));
  TrackResult last;
  for (int i = 4; i < 7; ++i) last = tracker.TrackFrame(second.Frame(i, 0.2));
  return second.MeanError(last, 0.2);
}

TEST(Dynamic, FollowsAHalfTurnFromOneFrameToTheNextIfFacingIsChecked) {
  EXPECT_GT(ErrorAfterAHalfTurn(0.0), 0.05);
  EXPECT_LT(ErrorAfterAHalfTurn(FacingSettings{}.margin_m), 0.02);
}

// Both arms move by 70 degrees from one frame to the next, out of the association's reach.
std::vector<TrackResult> ResultsOfALeap(double min_unexplained_m2, int threads) {
  FrameStage stage;
  Settings settings;
  settings.limbs.min_unexplained_m2 = min_unexplained_m2;
  settings.association.cutoff_m = 0.04;
  settings.threads = threads;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  std::vector<TrackResult> results;
  for (int i = 0; i < 6; ++i)
    results.push_back(tracker.TrackFrame(stage.Frame(i, i < 3 ? 0.0 : 1.2)));
  return results;
}

TEST(Dynamic, FindsArmsThatMovedTooFarWithinOneFrameIfLimbsAreSearched) {
  const FrameStage stage;
  EXPECT_LT(stage.MeanError(ResultsOfALeap(0.01, 2).back(), 1.2), 0.01);
  EXPECT_GT(stage.MeanError(ResultsOfALeap(0.0, 2).back(), 1.2), 0.02);
}

TEST(Dynamic, FindsLimbsWithTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<TrackResult> expected = ResultsOfALeap(0.01, 1);
  for (const int threads : {2, 3}) {
    const std::vector<TrackResult> results = ResultsOfALeap(0.01, threads);
    for (std::size_t i = 0; i < results.size(); ++i) {
      SCOPED_TRACE(fmt::format("frame {}, {} threads", i, threads));
      EXPECT_EQ(results[i].vertices, expected[i].vertices);
      EXPECT_EQ(results[i].condition, expected[i].condition);
    }
  }
}

std::vector<std::string> NamesOf(const std::vector<NamedValue>& energies) {
  std::vector<std::string> names;
  for (const NamedValue& energy : energies) names.push_back(energy.name);
  return names;
}

TEST(Dynamic, ReportsEveryTermOfItsEnergyInEveryFrame) {
  const std::vector<std::string> names(kEnergyTermNames.begin(), kEnergyTermNames.end());
  for (const Mode mode : {Mode::kFull, Mode::kShapeMatch, Mode::kSmoothBind}) {
    FrameStage stage;
    Settings settings;
    settings.mode = mode;
    Dynamic tracker(settings, HumanSkeleton());
    tracker.Start(stage.body, stage.camera);
    for (int i = 0; i < 4; ++i) {
      SCOPED_TRACE(fmt::format("mode {}, frame {}", static_cast<int>(mode), i));
      const bool is_empty = i == 2;
      const DepthFrame frame =
          is_empty ? DepthFrame{i, i / 30.0, DepthImage(320, 240)} : stage.Frame(i, 0.3 + 0.04 * i);
      const TrackResult result = tracker.TrackFrame(frame);
      ASSERT_EQ(NamesOf(result.energies), names);
      const bool has_shape_step =
          !is_empty && (mode == Mode::kFull || (mode == Mode::kShapeMatch && i == 0));
      for (int term = 0; term < kEnergyTermCount; ++term) {
        const bool is_evaluated = term >= kShapeDataTerm ? has_shape_step : !is_empty;
        EXPECT_EQ(result.energies[term].value > 0.0, is_evaluated) << names[term];
      }
    }
  }
}

TEST(Dynamic, SaysLostWhenTheDataAreElsewhere) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  const TrackResult result = tracker.TrackFrame({1, 1 / 30.0, DepthImage(320, 240, 6.0f)});
  EXPECT_EQ(result.outcome, Outcome::kLost);
  EXPECT_NE(result.message.find("found a vertex"), std::string::npos);
  for (std::size_t j = 0; j < result.joints.size(); ++j) {  // nothing observed: all joints frozen
    EXPECT_EQ(result.joints[j], before.joints[j]);
  }
}

// Some empty frames, then the body stands 0.9 m aside and 0.5 m farther away, out of reach.
double ErrorAfterReEntry(double lost_above) {
  FrameStage first;
  Rigidd elsewhere = CameraFromStart();
  elsewhere.translation += Vector3d(-0.9, 0.0, 0.5);
  ArmStage second{2, SkinDualQuaternion, elsewhere};
  Settings settings;
  settings.watch.lost_above = lost_above;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(first.body, first.camera);
  for (int i = 0; i < 2; ++i) tracker.TrackFrame(first.Frame(i, 0.0));
  tracker.TrackFrame({2, 2 / 30.0, DepthImage(320, 240)});
  TrackResult last;
  for (int i = 3; i < 6; ++i) last = tracker.TrackFrame(second.Frame(i, 0.0));
  return second.MeanError(last, 0.0);
}

TEST(Dynamic, FindsABodyThatReEntersElsewhereIfAreasAreWatched) {
  EXPECT_GT(ErrorAfterReEntry(0.0), 0.5);
  EXPECT_LT(ErrorAfterReEntry(0.065), 0.02);
}

// What the frame shows of the body is enough to go on, but an arm is missing.
TEST(Dynamic, SaysLostWhenAreasAreWatchedAndALimbIsContradicted) {
  const auto outcome_without_arm = [](double lost_above) {
    FrameStage stage;
    Settings settings;
    settings.watch.lost_above = lost_above;
    Dynamic tracker(settings, HumanSkeleton());
    tracker.Start(stage.body, stage.camera);
    EXPECT_FALSE(IsFailure(tracker.TrackFrame(stage.Frame(0, 0.0)).outcome));
    DepthFrame frame = stage.Frame(1, 0.0);
    for (int v = 0; v < frame.depth.height(); ++v) {
      for (int u = 0; u < 125; ++u) frame.depth(u, v) = 0.0f;
    }
    return tracker.TrackFrame(frame).outcome;
  };
  EXPECT_FALSE(IsFailure(outcome_without_arm(0.0)));
  EXPECT_EQ(outcome_without_arm(0.03), Outcome::kLost);
}

TEST(Dynamic, FewPointsAmongManyOthersDoNotCarryTheBodyAway) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  const TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.0));
  for (int i = 1; i <= 5; ++i) {
    // A wall before the camera leaves the left of the image to see, and what is there has moved.
    DepthFrame frame = stage.Frame(i, 0.1 * i);
    for (int v = 0; v < frame.depth.height(); ++v) {
      for (int u = 130; u < frame.depth.width(); ++u) frame.depth(u, v) = 0.9f;
    }
    const TrackResult covered = tracker.TrackFrame(frame);
    EXPECT_EQ(covered.outcome, Outcome::kLost);
    EXPECT_EQ(covered.vertices, before.vertices);
  }
  const TrackResult after = tracker.TrackFrame(stage.Frame(6, 0.0));
  EXPECT_FALSE(IsFailure(after.outcome)) << after.message;
  EXPECT_LT(stage.MeanError(after, 0.0), 0.01);
}

// How far the head's joint is carried off by a plate, some fingers wide, before a quarter of
// the face, metres.
double HeadCarriedBy(const Settings& settings) {
  FrameStage stage;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  TrackResult result = tracker.TrackFrame(stage.Frame(0, 0.0));
  const int head = static_cast<int>(BoneId::kHead);
  const Vector3d before = result.camera_from_rest[head] * stage.body.skeleton.tips[head];
  const auto at = stage.camera.Project(before).eval();
  for (int i = 1; i <= 10; ++i) {
    DepthFrame frame = stage.Frame(i, 0.0);
    for (int v = 0; v < 8; ++v) {
      for (int u = 0; u < 8; ++u) {
        const int column = static_cast<int>(at.x()) + u, row = static_cast<int>(at.y()) + v;
        frame.depth(column, row) = static_cast<float>(before.z()) - 0.18f;
      }
    }
    result = tracker.TrackFrame(frame);
    EXPECT_FALSE(IsFailure(result.outcome)) << result.message;
  }
  return (result.camera_from_rest[head] * stage.body.skeleton.tips[head] - before).norm();
}

TEST(Dynamic, AHandBeforeTheFaceDoesNotCarryTheHeadAway) {
  Settings settings;
  EXPECT_LT(HeadCarriedBy(settings), 0.002);
  settings.association.last_cutoff_m = settings.association.cutoff_m;
  EXPECT_GT(HeadCarriedBy(settings), 0.03);  // what the narrow cutoff is for
}

TEST(Dynamic, RefusesACutoffThatRises) {
  AssociationSettings settings;
  settings.last_cutoff_m = 2.0 * settings.cutoff_m;
  EXPECT_THAT(settings.Problem(), testing::HasSubstr("expected at most cutoff_m, 0.12 m"));
}

TEST(Dynamic, FreezesWhatIsOutOfView) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  TrackResult before = tracker.TrackFrame(stage.Frame(0, 0.3));
  before = tracker.TrackFrame(stage.Frame(1, 0.3));
  const int elbow = static_cast<int>(BoneId::kRightForearm);
  DepthFrame cut = stage.Frame(2, 0.3);
  const auto column = static_cast<int>(stage.camera.Project(before.joints[elbow]).x());
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < column + 4; ++u) cut.depth(u, v) = 0.0f;  // the subject's right arm
  }
  const TrackResult after = tracker.TrackFrame(cut);
  const auto local = [&](const TrackResult& r) -> Matrix3<double> {
    return r.camera_from_rest[static_cast<int>(BoneId::kRightUpperArm)].rotation.transpose() *
           r.camera_from_rest[elbow].rotation;
  };
  EXPECT_LT((local(after) - local(before)).norm(), 1e-12);
}

TEST(Dynamic, DoesNotDriftWhileABodyStands) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  const DepthFrame frame = stage.Frame(0, 0.2);
  for (int i = 0; i < 30; ++i) tracker.TrackFrame(frame);
  const TrackResult early = tracker.TrackFrame(frame);
  for (int i = 0; i < 100; ++i) tracker.TrackFrame(frame);
  const TrackResult late = tracker.TrackFrame(frame);
  for (std::size_t j = 0; j < late.joints.size(); ++j) {
    EXPECT_LT((late.joints[j] - early.joints[j]).norm(), 2e-3) << j;
  }
}

// All frames' vertices and energies, the pose step on all vertices or on a quarter of them.
std::vector<TrackResult> ResultsOn(int threads, int stride) {
  FrameStage stage;
  Settings settings;
  settings.threads = threads;
  settings.association.pose_vertex_stride = stride;
  settings.association.pose_pixel_stride = stride;
  Dynamic tracker(settings, HumanSkeleton());
  tracker.Start(stage.body, stage.camera);
  std::vector<TrackResult> results;
  for (int i = 0; i < 3; ++i) results.push_back(tracker.TrackFrame(stage.Frame(i, 0.05 * i)));
  return results;
}

TEST(Dynamic, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const int stride : {1, 2}) {
    const std::vector<TrackResult> expected = ResultsOn(1, stride);
    for (const int threads : {2, 3, 4}) {
      const std::vector<TrackResult> results = ResultsOn(threads, stride);
      for (std::size_t i = 0; i < results.size(); ++i) {
        SCOPED_TRACE(fmt::format("frame {}, {} threads, stride {}", i, threads, stride));
        EXPECT_EQ(results[i].vertices, expected[i].vertices);
        EXPECT_EQ(results[i].joints, expected[i].joints);
        EXPECT_EQ(results[i].condition, expected[i].condition);
        for (std::size_t k = 0; k < results[i].energies.size(); ++k)
          EXPECT_EQ(results[i].energies[k].value, expected[i].energies[k].value) << k;
      }
    }
  }
}

TEST(Dynamic, IgnoresPixelsThatAreNoNumbers) {
  FrameStage stage;
  DepthFrame frame = stage.Frame(0, 0.1);
  DepthFrame damaged = frame;
  for (int u = 0; u < 320; u += 2) {
    frame.depth(u, 20) = 0.0f;
    damaged.depth(u, 20) = u % 4 == 0 ? std::numeric_limits<float>::quiet_NaN() : -1.0f;
  }
  Dynamic with_nan(Settings{}, HumanSkeleton()), without(Settings{}, HumanSkeleton());
  with_nan.Start(stage.body, stage.camera);
  without.Start(stage.body, stage.camera);
  EXPECT_EQ(with_nan.TrackFrame(damaged).vertices, without.TrackFrame(frame).vertices);
}

TEST(Dynamic, RefusesWhatItCannotUse) {
  FrameStage stage;
  Dynamic tracker(Settings{}, HumanSkeleton());
  EXPECT_THROW(tracker.TrackFrame(stage.Frame(0, 0.0)), std::invalid_argument);  // before Start
  const auto message = [&](const BodyModel& body) -> std::string {
    try {
      tracker.Start(body, stage.camera);
    } catch (const DataError& error) {
      return error.what();
    }
    return "no error";
  };
  BodyModel without_weights = stage.body;
  without_weights.weights.weights[3] = {0.0f, 0.0f, 0.0f, 0.0f};
  EXPECT_THAT(message(without_weights), testing::HasSubstr("vertex 3: weights sum to 0"));
  BodyModel with_a_hole = stage.body;
  with_a_hole.rest.triangles.pop_back();
  EXPECT_THAT(message(with_a_hole), testing::HasSubstr("mesh"));
  tracker.Start(stage.body, stage.camera);
  EXPECT_THROW(tracker.TrackFrame({0, 0.0, DepthImage(64, 48)}), std::invalid_argument);
}

// ---- The pose step's solver ----

struct SolverStage {
  SolverStage()
      : body(TinyBody()),
        tree(HumanSkeleton(), body.skeleton),
        solver(tree, body.weights),
        may_move(tree.joint_count(), 1) {
    RandomStream random(3, "solver");
    Eigen::MatrixXd rows(2 * tree.joint_count(), tree.joint_count());
    for (double& entry : rows.reshaped()) entry = random.Normal();
    equations.hessian = rows.transpose() * rows;
    equations.gradient = Eigen::VectorXd::Constant(tree.joint_count(), 0.01);
    equations.observed.fill(1000);
    theta = RandomTheta(tree, 0.01, 4);
  }

  BodyModel body;
  KinematicTree tree;
  PoseSolver solver;
  PoseEquations equations;
  std::vector<char> may_move;
  Eigen::VectorXd theta;
};

TEST(PoseSolver, SolvesTheDampedEquationsWithTheDefaultPosePrior) {
  SolverStage s;
  const PoseStepWeights weights{0.3, 1e-3, 0.0};
  Eigen::MatrixXd system = s.equations.hessian;
  Eigen::VectorXd right = s.equations.gradient;
  double default_pose_energy = 0.0;
  for (int k = 0; k < s.tree.joint_count(); ++k) {
    const double d = s.tree.joints()[k].prior * s.solver.MovedVertices(k);
    system(k, k) += weights.damping + weights.default_pose_weight * d;
    right[k] += weights.default_pose_weight * d * s.theta[k];
    default_pose_energy += weights.default_pose_weight * d * s.theta[k] * s.theta[k];
  }
  const Eigen::VectorXd expected = s.theta - system.inverse() * right;
  const PoseStep step = s.solver.Step(s.tree, s.equations, s.may_move, weights, s.theta);
  EXPECT_TRUE(step.solved);
  EXPECT_LT((s.theta - expected).norm(), 1e-10);
  EXPECT_GT(default_pose_energy, 0.0);
  EXPECT_NEAR(step.default_pose_energy, default_pose_energy, 1e-12 * default_pose_energy);
}

TEST(PoseSolver, CountsTheVerticesThatAJointMoves) {
  const SolverStage s;
  EXPECT_NEAR(s.solver.MovedVertices(0), static_cast<double>(s.body.rest.vertices.size()), 1e-3);
}

TEST(PoseSolver, FreezesJointsThatMayNotMoveOrAreNotObserved) {
  SolverStage s;
  const Eigen::VectorXd before = s.theta;
  const int hand = static_cast<int>(BoneId::kLeftHand);
  s.may_move[0] = 0;
  s.equations.observed[hand] = 0;
  s.solver.Step(s.tree, s.equations, s.may_move, {0.3, 0.0, 0.01}, s.theta);
  EXPECT_EQ(s.theta[0], before[0]);
  EXPECT_NE(s.theta[1], before[1]);
  const int wrist = s.tree.ChainOf(hand).back();
  EXPECT_EQ(s.theta[wrist], before[wrist]);
  int frozen = 0;
  for (int k = 0; k < s.tree.joint_count(); ++k) frozen += s.solver.IsFrozen(k) ? 1 : 0;
  EXPECT_EQ(frozen, 3);  // the prismatic joint, and the two hinges of the wrist
}

TEST(PoseSolver, LeavesThePoseWhereTheEquationsAreBroken) {
  SolverStage s;
  const Eigen::VectorXd before = s.theta;
  s.equations.hessian(2, 2) = -1e9;
  EXPECT_FALSE(s.solver.Step(s.tree, s.equations, s.may_move, {0.3, 0.0, 0.0}, s.theta).solved);
  EXPECT_EQ(s.theta, before);
  s.equations.hessian(2, 2) = 1.0;
  s.equations.gradient[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(s.solver.Step(s.tree, s.equations, s.may_move, {0.3, 0.0, 0.0}, s.theta).solved);
  EXPECT_EQ(s.theta, before);
}

}  // namespace
}  // namespace vitruvia::dynamic
