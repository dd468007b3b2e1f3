#include "fitting/pose_fit.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "fitting/surface_target.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {
namespace {

// A mannequin that grows by a tenth with its only coefficient.
ShapedBody GrowingBody() {
  ShapedBody body = RigidShape(Refine(MakeControlBody(BodySettings()), {.subdivisions = 1}), 400);
  body.basis.resize(static_cast<Eigen::Index>(3 * body.mean.size()), 1);
  for (std::size_t v = 0; v < body.mean.size(); ++v)
    body.basis.block<3, 1>(static_cast<Eigen::Index>(3 * v), 0) = 0.1f * body.mean[v];
  body.joint_basis.setZero(6 * kBoneCount, 1);
  for (int b = 0; b < kBoneCount; ++b) {
    body.joint_basis.block<3, 1>(3 * b, 0) = 0.1 * body.skeleton.joints[b];
    body.joint_basis.block<3, 1>(3 * (kBoneCount + b), 0) = 0.1 * body.skeleton.tips[b];
  }
  return body;
}

BodyState Crouching(double size) {
  AnatomicalPose pose;
  pose.sides_deg[kLeft] = {20, 30, 5, 40, 10, 0, 0, 40, 10, 0, 60, 5, 0};
  pose.sides_deg[kRight] = {30, 25, 5, 60, 10, 0, 0, 30, 10, 0, 50, 5, 0};
  BodyState state;
  state.rotation = ExpSo3<double>({0.05, 0.4, 0.0});
  state.pelvis_position = {0.1, 0.8, 0.2};
  state.angles_deg = AnglesOf(pose);
  state.theta = Eigen::VectorXd::Constant(1, size);
  return state;
}

OrientedPoints SurfaceOf(const ShapedBody& body, const BodyState& state) {
  PosedBody posed(body);
  posed.Set(state);
  return SampleSurface({posed.vertices(), body.triangles}, 3000);
}

// The step of the shape in a fit of all parameters is that of the equations without the pose.
TEST(PoseFit, EquationsOfShapeGiveTheStepOfTheWholeFit) {
  const ShapedBody body = GrowingBody();
  const BodyState start = Crouching(0.0);
  SurfaceTarget target(SurfaceOf(body, Crouching(0.15)), 400, Clothing::kNone);
  const FitStage stage{1, 0.1, 0.1, 0.2, true};
  FitPriors priors;
  priors.angles_deg = start.angles_deg;
  priors.theta = start.theta;
  PoseFit fit(body);
  const ShapeEquations equations = fit.EquationsOfShape(target, start, stage, priors);
  ASSERT_EQ(equations.hessian.rows(), 1);
  const double step = -equations.gradient[0] / (equations.hessian(0, 0) + 1.0);
  const BodyState moved = fit.Run(target, start, stage, priors);
  EXPECT_GT(std::abs(step), 0.01);
  EXPECT_NEAR(moved.theta[0], step, 1e-6);
}

TEST(PoseFit, WithoutPairsNothingIsSaidOfTheShape) {
  const ShapedBody body = GrowingBody();
  BodyState far = Crouching(0.0);
  far.pelvis_position.x() += 50.0;
  SurfaceTarget target(SurfaceOf(body, Crouching(0.0)), 400, Clothing::kNone);
  FitPriors priors;
  priors.theta = far.theta;
  const ShapeEquations equations =
      PoseFit(body).EquationsOfShape(target, far, {1, 0.1, 0.1, 0.2, true}, priors);
  EXPECT_EQ(equations.hessian.norm(), 0.0);
  EXPECT_EQ(equations.gradient.norm(), 0.0);
}

}  // namespace
}  // namespace vitruvia
