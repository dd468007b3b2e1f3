#include "fitting/pose_search.h"

#include <gtest/gtest.h>

#include "fitting/depth_target.h"
#include "fitting/surface_target.h"
#include "geometry/zbuffer.h"
#include "math/angles.h"
#include "math/rotation.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {
namespace {

BodyModel Person() { return Refine(MakeControlBody(BodySettings()), {.subdivisions = 2}); }

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
  const BodyModel body = Person();
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

TEST(PoseSearch, FindsAPersonInADepthFrame) {
  const BodyModel body = Person();
  const ShapedBody fine = RigidShape(body, 1200), coarse = Coarser(fine, 300);
  PoseFit fine_fit(fine), coarse_fit(coarse);
  const Matrix3<double> facing = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  BodyState truth = Striding(30.0);
  truth.rotation = facing * truth.rotation;
  truth.pelvis_position = {0.1, 0.2, 2.6};
  const PinholeCamera camera;
  ZBuffer zbuffer(camera);
  const DepthImage depth = zbuffer.Render(Posed(body, fine, truth), body.rest.triangles);
  DepthTarget coarse_target(depth, camera, {80, 1500, 300});
  DepthTarget fine_target(depth, camera, {160, 4000, 1000});
  const std::vector<PoseHypothesis> hypotheses = StartHypotheses(facing, 8, Eigen::VectorXd());
  const SearchOutcome found =
      SearchPose(hypotheses,
                 {{&coarse_fit, &coarse_target, {5, 0.6, 0.3, 1.0, false}, 16},
                  {&coarse_fit, &coarse_target, {8, 0.3, 0.12, 0.3, false}, 5},
                  {&fine_fit, &fine_target, {12, 0.15, 0.05, 0.05, false}, 2}},
                 FitPriors(), NearFar());
  EXPECT_LT(MeanJointDistance(fine, found.best.state, truth), 0.03);
  EXPECT_GT(found.best.distance.target_explained, 0.95);
}

}  // namespace
}  // namespace vitruvia
