// Twists and rows against central differences in double, and the reduction against both.
#include "articulated/pose_system.h"

#include <functional>

#include <gtest/gtest.h>

#include "fitting/state_step.h"
#include "math/rigid.h"
#include "support/body_states.h"
#include "support/tiny_body.h"

namespace vitruvia::articulated {
namespace {

using Parameters = Eigen::VectorXd;

class PoseSystemTest : public testing::Test {
 protected:
  // A parameter's step that stays clear of the limits, which Moved keeps.
  static BodyState MovedFreely(BodyState state, const Parameters& step) {
    state.rotation = ExpSo3<double>(step.segment<3>(PosedBody::kRotation)) * state.rotation;
    state.pelvis_position += step.segment<3>(PosedBody::kPosition);
    state.angles_deg += step.segment<kAngleCount>(PosedBody::kAngles) / kRadiansPerDegree;
    return state;
  }

  Vector3d Place(int bone, const Vector3d& rest, const BodyState& state) const {
    return WorldFromRest(body_, state)[bone] * rest;
  }

  // Central differences of a number that depends on the state.
  Parameters Differences(const BodyState& state,
                         const std::function<double(const BodyState&)>& of) const {
    constexpr double kStep = 1e-5;
    Parameters result(kParameterCount);
    for (int k = 0; k < kParameterCount; ++k) {
      const Parameters step = kStep * Parameters::Unit(kParameterCount, k);
      result[k] = (of(MovedFreely(state, step)) - of(MovedFreely(state, -step))) / (2.0 * kStep);
    }
    return result;
  }

  const ShapedBody body_ = RigidShape(TinyBody(), 10000);
};

TEST_F(PoseSystemTest, ARowOfOneBoneIsTheDerivative) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const BodyState state = RandomState(30.0, seed);
    MovingBones bones(body_);
    bones.Set(state);
    bones.Differentiate();
    for (const int bone : {0, 2, 4, 6, 7, 10, 13, 16}) {
      const Vector3d rest = body_.skeleton.tips[bone], n(0.3, -0.5, 0.8);
      PoseSystem system;
      system.AddRow(bone, Place(bone, rest, state), n, 1.0, 1.0);
      system.Reduce(bones.twists());
      const Parameters expected = Differences(
          state, [&](const BodyState& moved) { return n.dot(Place(bone, rest, moved)); });
      EXPECT_LT((system.gradient() - expected).norm(), 1e-5 * expected.norm()) << bone;
      EXPECT_LT((system.hessian() - expected * expected.transpose()).norm(),
                1e-5 * expected.squaredNorm());
    }
  }
}

TEST_F(PoseSystemTest, ARowOfTwoBonesIsTheDerivativeOfTheirDistance) {
  const BodyState state = RandomState(30.0, 4);
  MovingBones bones(body_);
  bones.Set(state);
  bones.Differentiate();
  const int a = static_cast<int>(BoneId::kLeftHand), b = static_cast<int>(BoneId::kRightThigh);
  const Vector3d rest_a = body_.skeleton.tips[a], rest_b = body_.skeleton.tips[b];
  const auto distance = [&](const BodyState& moved) {
    return (Place(a, rest_a, moved) - Place(b, rest_b, moved)).norm();
  };
  const Vector3d apart = Place(a, rest_a, state) - Place(b, rest_b, state);
  PoseSystem system;
  system.AddPairRow(a, Place(a, rest_a, state), b, Place(b, rest_b, state), apart.normalized(), 0.5,
                    3.0);
  system.Reduce(bones.twists());
  const Parameters expected = 3.0 * 0.5 * Differences(state, distance);
  EXPECT_LT((system.gradient() - expected).norm(), 1e-5 * expected.norm());
  EXPECT_DOUBLE_EQ(system.energy(), 3.0 * 0.25);
}

TEST_F(PoseSystemTest, ABlendedRowIsTheDerivativeOfASkinnedPoint) {
  const BodyState state = RandomState(30.0, 5);
  MovingBones bones(body_);
  bones.Set(state);
  bones.Differentiate();
  const std::array chain{6, 5, 2};
  const std::array weights{0.5, 0.3, 0.2};
  const Vector3d rest = body_.skeleton.joints[6], n(0.1, 0.9, -0.4);
  const auto along = [&](const BodyState& moved) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += weights[k] * n.dot(Place(chain[k], rest, moved));
    return sum;
  };
  std::vector<CarriedPoint> shares;
  for (int k = 0; k < 3; ++k) {
    shares.push_back({chain[k], weights[k], Place(chain[k], rest, state)});
  }
  PoseSystem system;
  system.AddBlendedRow(shares, n, 1.0, 1.0);
  system.Reduce(bones.twists());
  const Parameters expected = Differences(state, along);
  EXPECT_LT((system.gradient() - expected).norm(), 1e-5 * expected.norm());
}

// What is solved for the angles does not depend on where the body and the data are; the step of the
// whole body turns with them.
TEST_F(PoseSystemTest, ARigidMotionOfBodyAndDataChangesNoAngle) {
  const BodyState state = RandomState(20.0, 6);
  const Rigidd motion{ExpSo3<double>({0.4, -0.7, 0.2}), {0.3, -0.2, 1.1}};
  BodyState moved = state;
  moved.rotation = motion.rotation * state.rotation;
  moved.pelvis_position = motion * state.pelvis_position;
  const auto solve = [&](const BodyState& at, const Rigidd& with) {
    MovingBones bones(body_);
    bones.Set(at);
    bones.Differentiate();
    RandomStream random(7, "data");
    PoseSystem system;
    for (int i = 0; i < 400; ++i) {
      const int bone = i % kBoneCount;
      const auto some = [&](double range) { return random.Uniform(-range, range); };
      const Vector3d rest = body_.skeleton.joints[bone] + Vector3d(some(0.1), some(0.1), some(0.1));
      const Vector3d n = Vector3d(some(1.0), some(1.0), some(1.0)).normalized();
      system.AddRow(bone, Place(bone, rest, at), with.rotation * n, some(0.01), 1.0);
    }
    system.Reduce(bones.twists());
    Eigen::MatrixXd hessian = system.hessian();
    hessian.diagonal().array() += 1e-3;
    return SolveWithinLimits(hessian, system.gradient(), at.angles_deg, kParameterCount);
  };
  const Parameters here = solve(state, {}), there = solve(moved, motion);
  EXPECT_LT((here.tail(kAngleCount) - there.tail(kAngleCount)).norm(), 1e-9);
  for (const int k : {PosedBody::kRotation, PosedBody::kPosition}) {
    EXPECT_LT((motion.rotation * here.segment<3>(k) - there.segment<3>(k)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace vitruvia::articulated
