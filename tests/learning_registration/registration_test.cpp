#include "learning/registration/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/zbuffer.h"
#include "math/angles.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "support/small_space.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

const ShapeSpace& SmallSpace() {
  static const ShapeSpace space = LearnSmallSpace(24, 5);
  return space;
}

RegistrationSettings QuickSettings() {
  RegistrationSettings settings;
  settings.components = 5;
  settings.search.headings = 4;
  settings.clothing = Clothing::kNone;
  settings.search.coarse_vertices = 300;
  settings.search.fine_vertices = 1000;
  settings.surface_points = 6000;
  return settings;
}

// Somebody of the space, the left forearm raised, a step forward, turned to the left by 80 degrees.
struct Posed {
  BodyModel body;
  std::vector<Vector3d> joints;
  TriangleMesh surface;
};

Posed SomebodyStriding(const Matrix3<double>& world_from_front, const Vector3d& pelvis) {
  Posed posed;
  Eigen::VectorXd theta(5);
  theta << 0.8, -0.6, 0.3, 0.0, 0.2;
  posed.body = PlacedBody(SmallSpace(), theta, Sex::kMale);
  AnatomicalPose angles;
  angles.midline_deg[kSpineFlexion] = 6.0;
  angles.sides_deg[kLeft] = {15, 18, 0, 80, 10, 0, 0, 25, 4, 0, 15, 0, 0};
  angles.sides_deg[kRight] = {-10, 14, 0, 12, 10, 0, 0, -12, 4, 0, 20, 0, 0};
  JointPose pose = JointPose::Rest(posed.body.skeleton);
  SetRotations(angles, pose);
  pose.local_rotations[0] = world_from_front * ExpSo3<double>({0.0, 80.0 * kRadiansPerDegree, 0.0});
  pose.pelvis_position = pelvis;
  const BoneTransforms bones = ForwardKinematics(posed.body.skeleton, pose);
  posed.joints = PosedJoints(posed.body.skeleton, bones);
  posed.surface.triangles = posed.body.rest.triangles;
  SkinLinear(posed.body.rest.vertices, posed.body.weights, bones, posed.surface.vertices);
  return posed;
}

double MeanJointError(const Registrar& registrar, const Registration& found, const Posed& truth) {
  const std::vector<Vector3d> joints = PosedJoints(registrar.Body(found.state.theta).skeleton,
                                                   registrar.SurfaceFromSubject(found.state));
  double sum = 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) sum += (joints[j] - truth.joints[j]).norm();
  return sum / static_cast<double>(joints.size());
}

// The search takes most of these tests' time; several look at its result.
struct FoundOnSurface {
  Posed truth = SomebodyStriding(Matrix3<double>::Identity(), {0.4, 1.0, 0.2});
  Registrar registrar{SmallSpace(), {}, QuickSettings()};
  Registration found = registrar.Find(truth.surface);
};
FoundOnSurface& Found() {
  static FoundOnSurface found;
  return found;
}

TEST(Registration, FindsPoseAndShapeOfSomebodyOfTheSpace) {
  const auto& [truth, registrar, found] = Found();
  EXPECT_EQ(found.problem, "");
  EXPECT_LT(MeanJointError(registrar, found, truth), 0.012);
  EXPECT_LT(found.distance.mean_m(), 0.005);
  EXPECT_GT(found.margin, 0.5);
  EXPECT_NEAR(registrar.Body(found.state.theta).attributes.height_m, truth.body.attributes.height_m,
              0.02);
}

TEST(Registration, FollowsToTheNextSurface) {
  auto& [truth, registrar, first] = Found();
  Posed moved = truth;
  for (Vector3f& v : moved.surface.vertices) v += Vector3f(0.06f, 0.0f, -0.05f);
  for (Vector3d& j : moved.joints) j += Vector3d(0.06, 0.0, -0.05);
  const Registration next = registrar.Follow(moved.surface, first.state);
  EXPECT_EQ(next.state.theta, first.state.theta);
  EXPECT_LT(MeanJointError(registrar, next, moved), 0.012);
}

// The frame alone would have the person of their own height.
TEST(Registration, FindsAPersonInADepthFrameAndHoldsTheGivenHeight) {
  const Posed truth = SomebodyStriding(Vector3d(1.0, -1.0, -1.0).asDiagonal(), {0.1, 0.1, 2.6});
  const PinholeCamera camera;
  ZBuffer zbuffer(camera);
  const double given_m = truth.body.attributes.height_m + 0.04;
  Registrar registrar(SmallSpace(), {given_m, {}, {}}, QuickSettings());
  const Registration found =
      registrar.Find(zbuffer.Render(truth.surface.vertices, truth.surface.triangles), camera);
  EXPECT_EQ(found.problem, "");
  EXPECT_LT(MeanJointError(registrar, found, truth), 0.04);
  EXPECT_NEAR(registrar.Body(found.state.theta).attributes.height_m, given_m, 0.002);
}

TEST(Registration, RefusesWhatIsNoPerson) {
  Registrar registrar(SmallSpace(), {}, QuickSettings());
  const Posed person = SomebodyStriding(Matrix3<double>::Identity(), {0.0, 1.0, 0.0});
  TriangleMesh two = person.surface;
  TriangleMesh neighbor = person.surface;
  for (Vector3f& v : neighbor.vertices) v.x() += 1.2f;
  AppendSurface(neighbor.vertices, neighbor.triangles, two);
  EXPECT_THAT(registrar.Find(two).problem, HasSubstr("no person: the body explains"));

  TriangleMesh without_legs = person.surface;
  std::erase_if(without_legs.triangles,
                [&](const Triangle& t) { return person.surface.vertices[t[0]].y() < 0.9f; });
  without_legs.vertices = person.surface.vertices;
  EXPECT_THAT(registrar.Find(without_legs).problem, HasSubstr("no person"));

  TriangleMesh in_millimetres = person.surface;
  for (Vector3f& v : in_millimetres.vertices) v *= 1000.0f;
  EXPECT_THAT(registrar.Find(in_millimetres).problem, HasSubstr("in metres?"));
}

// Of frames from two sides one shape, and nearer to the truth than that of the first frame alone.
TEST(Registration, FitsOneShapeToSeveralFrames) {
  const Matrix3<double> facing = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Posed left = SomebodyStriding(facing, {0.1, 0.1, 2.6});
  const Posed front = SomebodyStriding(
      facing * ExpSo3<double>({0.0, -80.0 * kRadiansPerDegree, 0.0}), {0.0, 0.1, 2.4});
  const PinholeCamera camera;
  std::vector<DepthImage> frames;
  for (const Posed* posed : {&left, &front}) {
    ZBuffer zbuffer(camera);
    frames.push_back(zbuffer.Render(posed->surface.vertices, posed->surface.triangles));
  }
  Registrar registrar(SmallSpace(), {}, QuickSettings());
  const std::vector<Registration> found = registrar.FindSame(frames, camera);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].problem, "");
  EXPECT_EQ(found[1].problem, "");
  EXPECT_EQ(found[0].state.theta, found[1].state.theta);
  EXPECT_LT(MeanJointError(registrar, found[0], left), 0.04);
  EXPECT_LT(MeanJointError(registrar, found[1], front), 0.04);
  EXPECT_NEAR(registrar.Body(found[0].state.theta).attributes.height_m,
              left.body.attributes.height_m, 0.03);
}

TEST(Registration, RefusesAnEmptyFrame) {
  const PinholeCamera camera;
  Registrar registrar(SmallSpace(), {}, QuickSettings());
  EXPECT_THAT(registrar.Find(DepthImage(camera.width, camera.height), camera).problem,
              HasSubstr("too few measurements"));
}

}  // namespace
}  // namespace vitruvia
