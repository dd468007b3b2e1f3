#include "fitting/pose_search.h"

#include <gtest/gtest.h>

#include "fitting/depth_search.h"
#include "fitting/joint_fit.h"
#include "fitting/surface_target.h"
#include "geometry/zbuffer.h"
#include "math/angles.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {
namespace {

const BodyModel& Person() {
  static const BodyModel person = Refine(MakeControlBody(BodySettings()), {.subdivisions = 2});
  return person;
}

// Striding, the right forearm raised, turned by `heading_deg`; y up.
BodyState Striding(double heading_deg) {
  AnatomicalPose pose;
  pose.midline_deg[kSpineFlexion] = 8.0;
  pose.midline_deg[kNeckTurn] = 15.0;
  pose.sides_deg[kLeft] = {20, 15, 5, 25, 10, 0, 0, 30, 5, 0, 20, 0, 0};
  pose.sides_deg[kRight] = {-10, 25, 0, 95, 0, 0, 0, -10, 8, 5, 30, -5, 0};
  BodyState state;
  state.rotation = ExpSo3<double>({0.0, heading_deg * kRadiansPerDegree, 0.0});
  state.pelvis_position = {0.2, 0.95, -0.3};
  state.angles_deg = AnglesOf(pose);
  return state;
}

std::vector<Vector3f> Posed(const BodyModel& body, const ShapedBody& shaped,
                            const BodyState& state) {
  std::vector<Vector3f> vertices;
  SkinLinear(body.rest.vertices, body.weights, WorldFromRest(shaped, state), vertices);
  return vertices;
}

TEST(PoseSearch, FindsAPersonOnASurface) {
  const BodyModel& body = Person();
  const ShapedBody fine = RigidShape(body, 1500), coarse = Coarser(fine, 400);
  PoseFit fine_fit(fine), coarse_fit(coarse);
  const BodyState truth = Striding(130.0);
  const OrientedPoints points =
      SampleSurface({Posed(body, fine, truth), body.rest.triangles}, 8000);
  SurfaceTarget coarse_target(points, 400, Clothing::kNone);
  SurfaceTarget fine_target(points, 1500, Clothing::kNone);
  const std::vector<PoseHypothesis> hypotheses =
      StartHypotheses(Matrix3<double>::Identity(), 8, Eigen::VectorXd());
  const SearchOutcome found =
      SearchPose(hypotheses,
                 {{&coarse_fit, &coarse_target, {6, 0.5, 0.25, 1.0, false}, 10},
                  {&coarse_fit, &coarse_target, {10, 0.3, 0.1, 0.2, false}, 4},
                  {&fine_fit, &fine_target, {15, 0.1, 0.02, 0.01, false}, 2}},
                 FitPriors(), NearFar());
  EXPECT_LT(MeanJointDistance(fine, found.best.state, truth), 0.005);
  EXPECT_GT(found.best.distance.target_explained, 0.98);
  EXPECT_GT(found.margin, 0.5);
}

// Seen by the default camera, 2.6 m away.
BodyState BeforeCamera(double heading_deg) {
  BodyState state = Striding(heading_deg);
  state.rotation = Vector3d(1.0, -1.0, -1.0).asDiagonal() * state.rotation;
  state.pelvis_position = {0.1, 0.2, 2.6};
  return state;
}

DepthImage FrameOf(const BodyModel& body, const ShapedBody& shaped, const BodyState& state) {
  ZBuffer zbuffer{PinholeCamera()};
  return zbuffer.Render(Posed(body, shaped, state), body.rest.triangles);
}

TEST(DepthSearch, FindsAPersonInADepthFrame) {
  const BodyModel& body = Person();
  const ShapedBody fine = RigidShape(body, 900), coarse = Coarser(fine, 300);
  PoseFit fine_fit(fine), coarse_fit(coarse);
  const BodyState truth = BeforeCamera(30.0);
  const DepthImage depth = FrameOf(body, fine, truth);
  DepthTarget coarse_target(depth, PinholeCamera(), {80, 1500, 300});
  DepthTarget fine_target(depth, PinholeCamera(), {160, 4000, 600});
  const std::vector<PoseHypothesis> hypotheses =
      StartHypotheses(Vector3d(1.0, -1.0, -1.0).asDiagonal(), 8, Eigen::VectorXd());
  const SearchOutcome found = SearchDepth(
      hypotheses, {&coarse_fit, &fine_fit, &coarse_target, &fine_target}, FitPriors(), NearFar());
  EXPECT_LT(MeanJointDistance(fine, found.best.state, truth), 0.02);
  EXPECT_GT(found.best.distance.target_explained, 0.97);
}

TEST(DepthSearch, ImageDistanceGrowsWithTheWayFromTheTruth) {
  const BodyModel& body = Person();
  const ShapedBody fine = RigidShape(body, 1200);
  const BodyState truth = BeforeCamera(0.0);
  DepthTarget target(FrameOf(body, fine, truth), PinholeCamera(), {160, 4000, 600});
  PosedBody posed(fine);
  const auto distance = [&](double aside_m, double behind_m) {
    BodyState state = truth;
    state.pelvis_position += Vector3d(aside_m, 0.0, behind_m);
    posed.Set(state);
    return target.ImageDistance(posed, 0.15);
  };
  EXPECT_LT(distance(0.0, 0.0), 0.03);
  EXPECT_NEAR(distance(0.0, 0.1), 0.1, 0.03);  // along the rays, but for the outline
  EXPECT_GT(distance(0.05, 0.0), 1.5 * distance(0.0, 0.0));
  EXPECT_NEAR(distance(0.9, 0.0), 0.3, 0.01);  // beside the frame's person: both count as far
}

TEST(JointFit, FindsTheStateOfKnownJoints) {
  const ShapedBody body = RigidShape(Person(), 300);
  const BodyState truth = Striding(130.0);
  const std::vector<Vector3d> joints = PosedJoints(body.skeleton, WorldFromRest(body, truth));
  KnownJoints known{{}, 0.005};
  for (int j = 0; j < kBoneCount; ++j) known.joints.push_back({j, joints[j]});
  const BodyState fitted = FittedToJoints(body, BodyState(), known, 40.0);
  EXPECT_LT(MeanJointDistance(body, fitted, truth), 0.01);
}

TEST(JointFit, OneJointLeavesTheOthersInTheStartPose) {
  const ShapedBody body = RigidShape(Person(), 300);
  const KnownJoints known{{{static_cast<int>(BoneId::kHead), Vector3d(1.0, 2.0, 3.0)}}, 0.02};
  const BodyState fitted = FittedToJoints(body, BodyState(), known, 40.0);
  EXPECT_LT((PosedJoints(body.skeleton, WorldFromRest(body, fitted))[known.joints[0].joint] -
             known.joints[0].position)
                .norm(),
            0.01);
  EXPECT_LT(fitted.angles_deg.cwiseAbs().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace vitruvia
