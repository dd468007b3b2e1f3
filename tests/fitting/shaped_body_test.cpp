#include "fitting/shaped_body.h"

#include <gtest/gtest.h>

#include "math/angles.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {
namespace {

// A mannequin that may grow: its second coefficient scales it, its first makes it deeper.
ShapedBody DeepeningBody() {
  ShapedBody body = RigidShape(Refine(MakeControlBody(BodySettings()), {.subdivisions = 1}), 400);
  const auto rows = static_cast<Eigen::Index>(3 * body.mean.size());
  body.basis.resize(rows, 2);
  for (std::size_t v = 0; v < body.mean.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(3 * v);
    body.basis.block<3, 1>(row, 0) = Vector3f(0.0f, 0.0f, 0.2f * body.mean[v].z());
    body.basis.block<3, 1>(row, 1) = 0.1f * body.mean[v];
  }
  body.joint_basis.setZero(6 * kBoneCount, 2);
  for (int b = 0; b < kBoneCount; ++b) {
    body.joint_basis.block<3, 1>(3 * b, 1) = 0.1 * body.skeleton.joints[b];
    body.joint_basis.block<3, 1>(3 * (kBoneCount + b), 1) = 0.1 * body.skeleton.tips[b];
  }
  return body;
}

BodyState SomeState() {
  BodyState state;
  state.rotation = ExpSo3<double>({0.1, 0.7, -0.2});
  state.pelvis_position = {0.3, 1.1, 2.5};
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleRanges& limits = JointLimits();
    const double share = 0.35 + 0.3 * (a % 5) / 4.0;
    state.angles_deg[a] = limits.min_deg[a] + share * (limits.max_deg[a] - limits.min_deg[a]);
  }
  state.theta = Eigen::Vector2d(0.4, -0.6);
  return state;
}

BodyState Moved(BodyState state, int parameter, double by) {
  if (parameter < PosedBody::kPosition) {
    state.rotation = ExpSo3<double>(by * Vector3d::Unit(parameter)) * state.rotation;
  } else if (parameter < PosedBody::kAngles) {
    state.pelvis_position[parameter - PosedBody::kPosition] += by;
  } else if (parameter < PosedBody::kShape) {
    state.angles_deg[parameter - PosedBody::kAngles] += by / kRadiansPerDegree;
  } else {
    state.theta[parameter - PosedBody::kShape] += by;
  }
  return state;
}

TEST(ShapedBody, AnglesSurviveTheWayThroughAPose) {
  const AngleVector angles = SomeState().angles_deg;
  EXPECT_EQ(AnglesOf(PoseOf(angles)), angles);
}

TEST(ShapedBody, LimitsAreThoseOfTheJoints) {
  EXPECT_EQ(JointLimits().min_deg[kSpineFlexion], -30.0);
  EXPECT_EQ(JointLimits().max_deg[int{kMidlineAngleCount} + int{kKneeFlexion}], 150.0);
  EXPECT_EQ(JointLimits().max_deg[int{kMidlineAngleCount} + int{kSideAngleCount} + kElbowFlexion],
            150.0);
}

TEST(ShapedBody, SurfaceIsSkinnedByForwardKinematics) {
  const BodyModel model = Refine(MakeControlBody(BodySettings()), {.subdivisions = 1});
  const ShapedBody body = RigidShape(model, 100000);
  BodyState state = SomeState();
  state.theta.resize(0);
  PosedBody posed(body);
  posed.Set(state);

  JointPose pose = JointPose::Rest(model.skeleton);
  SetRotations(PoseOf(state.angles_deg), pose);
  pose.local_rotations[0] = state.rotation;
  pose.pelvis_position = state.pelvis_position;
  std::vector<Vector3f> expected;
  SkinLinear(model.rest.vertices, model.weights, ForwardKinematics(model.skeleton, pose), expected);
  ASSERT_EQ(posed.vertices().size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v) {
    ASSERT_LT((posed.vertices()[v] - expected[v]).norm(), 1e-5f) << v;
  }
}

TEST(ShapedBody, RowsAreTheDerivativesOfTheSurface) {
  const ShapedBody body = DeepeningBody();
  const BodyState state = SomeState();
  PosedBody posed(body), moved(body);
  posed.Set(state);
  posed.Differentiate();
  std::vector<float> row(static_cast<std::size_t>(posed.parameter_count()));
  constexpr double kStep = 1e-2;
  for (int p = 0; p < posed.parameter_count(); ++p) {
    moved.Set(Moved(state, p, kStep));
    const std::vector<Vector3f> after = moved.vertices();
    moved.Set(Moved(state, p, -kStep));
    for (std::size_t v = 0; v < body.mean.size(); v += 7) {
      const Vector3f derivative =
          (after[v] - moved.vertices()[v]) / static_cast<float>(2.0 * kStep);
      for (int k = 0; k < 3; ++k) {
        posed.Row(static_cast<int>(v), Vector3f::Unit(k), row.data());
        ASSERT_NEAR(row[static_cast<std::size_t>(p)], derivative[k], 5e-4)
            << "parameter " << p << ", vertex " << v << ", coordinate " << k;
      }
    }
  }
}

}  // namespace
}  // namespace vitruvia
