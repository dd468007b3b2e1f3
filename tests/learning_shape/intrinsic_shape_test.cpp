// The fit to a scan, against planted shapes and finite differences.
#include "learning/shape/intrinsic_shape.h"

#include <numbers>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "small_database.h"
#include "support/ceres_adaptor.h"

namespace vitruvia {
namespace {

using testing::HasSubstr;

constexpr int kComponents = 8;

const ShapeSpace& Space() {
  static const ShapeSpace space = [] {
    std::vector<int> training(30);
    std::iota(training.begin(), training.end(), 0);
    return LearnShapeSpace(SmallDatabase(), training, {.components = kComponents});
  }();
  return space;
}

IntrinsicShapeSettings Settings() {
  IntrinsicShapeSettings settings;
  settings.components = kComponents;
  return settings;
}

TriangleMesh MeshOf(const std::vector<Vector3f>& vertices) {
  return {vertices, SmallDatabase().reference.rest.triangles};
}

double MeanVertexError(const std::vector<Vector3f>& a, const std::vector<Vector3f>& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += (a[v] - b[v]).norm();
  return sum / static_cast<double>(a.size());
}

IntrinsicShape FitTo(const TriangleMesh& scan, const BodyAttributes& attributes,
                     const IntrinsicShapeSettings& settings = Settings()) {
  return FitIntrinsicShape(Space(), Space(), SurfaceOf(scan), attributes, settings);
}

TEST(PosedShape, RowsAgreeWithFiniteDifferences) {
  PosedShape shape(Space(), kComponents);
  RandomStream random(1, "pose");
  Eigen::VectorXd bend(shape.parameter_count());
  for (double& x : bend) x = random.Uniform(-0.2, 0.2);
  const PosedShape::Parameters at = shape.Stepped(shape.Start(), bend);
  const Vector3f n = Vector3f(0.3f, 0.5f, -0.8f).normalized();
  std::vector<float> row(static_cast<std::size_t>(shape.parameter_count()));
  constexpr double kStep = 1e-2;  // vertices are floats
  for (const std::size_t vertex : {0ul, 333ul, 800ul, 1500ul}) {
    shape.Set(at);
    shape.Row(vertex, n, row.data());
    for (int k = 0; k < shape.parameter_count(); ++k) {
      double ends[2];
      for (const int side : {0, 1}) {
        Eigen::VectorXd step = Eigen::VectorXd::Zero(shape.parameter_count());
        step[k] = side == 0 ? -kStep : kStep;
        shape.Set(shape.Stepped(at, step));
        ends[side] = n.dot(shape.vertices()[vertex]);
      }
      EXPECT_NEAR(row[static_cast<std::size_t>(k)], (ends[1] - ends[0]) / (2.0 * kStep), 1e-4)
          << "vertex " << vertex << ", parameter " << k;
    }
  }
}

TEST(PosedShape, BendGradientsAgreeWithFiniteDifferences) {
  PosedShape shape(Space(), kComponents);
  RandomStream random(2, "bend");
  Eigen::VectorXd bend(shape.parameter_count());
  for (double& x : bend) x = random.Uniform(-0.5, 0.5);
  const PosedShape::Parameters at = shape.Stepped(shape.Start(), bend);
  const std::array<Vector3d, kBoneCount> gradients = PosedShape::BendGradients(at);
  constexpr double kStep = 1e-5;
  for (int b = 0; b < kBoneCount; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      double energies[2];
      for (const int side : {0, 1}) {
        Eigen::VectorXd step = Eigen::VectorXd::Zero(shape.parameter_count());
        step[shape.rotation_index(b) + axis] = side == 0 ? -kStep : kStep;
        energies[side] =
            0.5 * LogSo3<double>(shape.Stepped(at, step).local_rotations[b]).squaredNorm();
      }
      EXPECT_NEAR(gradients[b][axis], (energies[1] - energies[0]) / (2.0 * kStep), 1e-8)
          << "bone " << b << ", axis " << axis;
    }
  }
}

TEST(PosedShape, StartIsTheMeanShape) {
  PosedShape shape(Space(), kComponents);
  shape.Set(shape.Start());
  EXPECT_LT(MeanVertexError(shape.vertices(), Shape(Space(), Eigen::VectorXd::Zero(1))), 1e-6);
}

TEST(IntrinsicShape, FindsAHeldOutPersonWhereverTheyStand) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  TriangleMesh scan = MeshOf(person.vertices);
  for (Vector3f& v : scan.vertices) v += Vector3f(0.08f, 0.02f, -0.05f);
  const IntrinsicShape fit = FitTo(scan, person.attributes);
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(MeanVertexError(fit.in_scan, scan.vertices), 0.0015);
  const Eigen::Vector2d measured = MeasuredAttributes(Space(), fit.theta, person.attributes.sex);
  EXPECT_NEAR(measured[0], person.attributes.height_m, 1e-4);
  EXPECT_NEAR(measured[1], person.attributes.weight_kg, 1e-2);
}

TEST(IntrinsicShape, TakesUpArmsThatHang) {
  const DatabaseSubject& person = SmallDatabase().subjects[33];
  BodyModel body = SmallDatabase().reference;
  JointPose pose = JointPose::Rest(person.skeleton);
  pose.local_rotations[static_cast<int>(BoneId::kLeftUpperArm)] = ExpSo3<double>({0.0, 0.0, -0.14});
  pose.local_rotations[static_cast<int>(BoneId::kRightUpperArm)] = ExpSo3<double>({0.0, 0.05, 0.1});
  std::vector<Vector3f> posed;
  SkinLinear(person.vertices, body.weights, ForwardKinematics(person.skeleton, pose), posed);
  const IntrinsicShape fit = FitTo(MeshOf(posed), person.attributes);
  EXPECT_LT(MeanVertexError(fit.in_scan, posed), 0.002);
  const Vector3d turned =
      LogSo3<double>(fit.pose.local_rotations[static_cast<int>(BoneId::kLeftUpperArm)]);
  EXPECT_NEAR(turned.z(), -0.14, 0.02);
}

TEST(IntrinsicShape, GivenAttributesAreHeldEvenIfTheScanSaysOtherwise) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  BodyAttributes heavier = person.attributes;
  heavier.weight_kg += 5.0;
  const TriangleMesh scan = MeshOf(person.vertices);
  const IntrinsicShape held = FitTo(scan, heavier);
  EXPECT_NEAR(MeasuredAttributes(Space(), held.theta, heavier.sex)[1], heavier.weight_kg, 1e-2);
  IntrinsicShapeSettings ignoring = Settings();
  ignoring.attributes = AttributeUse::kIgnored;
  const IntrinsicShape free = FitTo(scan, heavier, ignoring);
  EXPECT_NEAR(MeasuredAttributes(Space(), free.theta, heavier.sex)[1], person.attributes.weight_kg,
              1.0);
}

// A body's nearest point within reach, by looking at all: index, or -1.
int Nearest(const Vector3f& query, const std::vector<Vector3f>& points, float reach) {
  int nearest = -1;
  float least = reach * reach;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float squared = (points[i] - query).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

struct WeightedPair {
  std::size_t vertex;
  Vector3f target, n;
  double weight;  // of its residual: unit, λ₁ and kernel
};

// The pairs of a fit at its solution, both ways.
std::vector<WeightedPair> PairsOf(const ScannedSurface& scan, const std::vector<Vector3f>& body,
                                  const IntrinsicShapeSettings& settings) {
  std::vector<Vector3f> normals;
  ComputeVertexNormals(body, Space().reference.rest.triangles, normals);
  const auto reach = static_cast<float>(settings.last_cutoff_m);
  std::vector<WeightedPair> pairs;
  const auto add = [&](std::size_t vertex, const Vector3f& target, const Vector3f& n,
                       const Vector3f& other_n) {
    if (n.dot(other_n) < 0.5f) return;  // 60 degrees
    const double relative = n.dot(body[vertex] - target) / settings.robust_m;
    pairs.push_back(
        {vertex, target, n,
         std::sqrt(settings.lambda) / settings.length_unit_m / (1.0 + relative * relative)});
  };
  for (std::size_t v = 0; v < body.size(); ++v) {
    const int s = Nearest(body[v], scan.points, reach);
    if (s >= 0) add(v, scan.points[s], scan.normals[s], normals[v]);
  }
  for (std::size_t s = 0; s < scan.points.size(); ++s) {
    const int v = Nearest(scan.points[s], body, reach);
    if (v >= 0) add(v, scan.points[s], normals[v], scan.normals[s]);
  }
  return pairs;
}

// By how much Ceres lowers the energy of a fit when it goes on from its solution with the same
// pairs, as a share.
double LoweredByCeres(const ScannedSurface& scan, const BodyAttributes& attributes,
                      const IntrinsicShapeSettings& settings) {
  const IntrinsicShape fit = FitIntrinsicShape(Space(), Space(), scan, attributes, settings);
  PosedShape shape(Space(), kComponents);
  shape.Set(fit.pose);
  const std::vector<WeightedPair> pairs = PairsOf(scan, shape.vertices(), settings);
  EXPECT_GT(pairs.size(), 2000u);
  const double per_radian = 180.0 / std::numbers::pi / settings.pose_slack_deg;
  const auto residuals = [&](const Eigen::VectorXd& step) {
    const PosedShape::Parameters at = shape.Stepped(fit.pose, step);
    shape.Set(at);
    Eigen::VectorXd r(pairs.size() + kComponents + 3 * (kBoneCount - 1));
    Eigen::Index row = 0;
    for (const WeightedPair& pair : pairs)
      r[row++] = pair.weight * pair.n.dot(shape.vertices()[pair.vertex] - pair.target);
    r.segment(row, kComponents) = at.theta;
    row += kComponents;
    for (int b = 1; b < kBoneCount; ++b, row += 3)
      r.segment<3>(row) = per_radian * LogSo3<double>(at.local_rotations[b]);
    return r;
  };
  const Eigen::VectorXd here = Eigen::VectorXd::Zero(shape.parameter_count());
  const double ours = residuals(here).squaredNorm();
  const CeresResult ceres = MinimizeWithCeres(residuals, here);
  EXPECT_TRUE(ceres.usable) << ceres.report;
  return (ours - ceres.energy) / ours;
}

IntrinsicShapeSettings FittedToTheEnd() {
  IntrinsicShapeSettings settings = Settings();
  settings.attributes = AttributeUse::kIgnored;
  settings.max_iterations = 100;
  settings.stop_m = 1e-7;
  return settings;
}

TEST(IntrinsicShape, CeresFindsNothingLowerForTheSamePairs) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  EXPECT_LT(LoweredByCeres(SurfaceOf(MeshOf(person.vertices)), person.attributes, FittedToTheEnd()),
            1e-3);
}

// Parents that are turned, and a prior so tight that it counts: the fit ends 2 % above the optimum
// if the prior's gradient is taken in the wrong frame.
TEST(IntrinsicShape, CeresFindsNothingLowerForAPersonTurnedAndBent) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  JointPose pose = JointPose::Rest(person.skeleton);
  pose.local_rotations[static_cast<int>(BoneId::kPelvis)] = ExpSo3<double>({0.0, 0.2, 0.0});
  pose.local_rotations[static_cast<int>(BoneId::kAbdomen)] = ExpSo3<double>({0.0, 0.0, 0.06});
  pose.local_rotations[static_cast<int>(BoneId::kLeftUpperArm)] = ExpSo3<double>({0.0, 0.0, -0.07});
  std::vector<Vector3f> posed;
  SkinLinear(person.vertices, SmallDatabase().reference.weights,
             ForwardKinematics(person.skeleton, pose), posed);
  IntrinsicShapeSettings settings = FittedToTheEnd();
  settings.pose_slack_deg = 1.0;
  settings.first_cutoff_m = 0.2;
  EXPECT_LT(LoweredByCeres(SurfaceOf(MeshOf(posed)), person.attributes, settings), 1e-4);
}

TEST(IntrinsicShape, ChoosesAsManyScanPointsAsAskedFor) {
  ScannedSurface scan;
  for (int i = 0; i < 1999; ++i) {
    scan.points.emplace_back(static_cast<float>(i), 0.0f, 0.0f);
    scan.normals.emplace_back(0.0f, static_cast<float>(i), 0.0f);
  }
  const ScannedSurface chosen = EvenlyChosen(scan, 1000);
  ASSERT_EQ(chosen.points.size(), 1000u);
  ASSERT_EQ(chosen.normals.size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(chosen.points[i].x(), chosen.normals[i].y());
    EXPECT_NEAR(chosen.points[i].x(), 1.999 * static_cast<double>(i), 1.0);
  }
  EXPECT_EQ(EvenlyChosen(scan, 1999).points, scan.points);
  EXPECT_EQ(EvenlyChosen(scan, 5000).points, scan.points);
}

TriangleMesh Without(const TriangleMesh& mesh, BoneId bone) {
  TriangleMesh rest = mesh;
  const SkinWeights& weights = SmallDatabase().reference.weights;
  std::erase_if(rest.triangles, [&](const Triangle& t) {
    return weights.bones[t[0]][0] == static_cast<std::uint8_t>(bone);
  });
  // Vertices that no triangle uses have no normal; a scan has none of them.
  std::vector<Vector3f> normals;
  ComputeVertexNormals(rest.vertices, rest.triangles, normals);
  std::vector<int> renumbered(rest.vertices.size(), -1);
  TriangleMesh packed;
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    if (normals[v].squaredNorm() == 0.0f) continue;
    renumbered[v] = static_cast<int>(packed.vertices.size());
    packed.vertices.push_back(rest.vertices[v]);
  }
  for (const Triangle& t : rest.triangles)
    packed.triangles.push_back({renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]});
  return packed;
}

template <class Error>
std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(IntrinsicShape, RefusesAScanThatLacksTheHead) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  const TriangleMesh headless = Without(MeshOf(person.vertices), BoneId::kHead);
  EXPECT_THAT(MessageOf<DataError>([&] { FitTo(headless, person.attributes); }),
              testing::AnyOf(HasSubstr("head"), HasSubstr("m high")));
}

TEST(IntrinsicShape, DoesWithoutSoles) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  TriangleMesh scan = MeshOf(person.vertices);
  std::erase_if(scan.triangles, [&](const Triangle& t) { return scan.vertices[t[0]].y() < 0.01f; });
  const IntrinsicShape fit = FitTo(scan, person.attributes);
  EXPECT_LT(MeanVertexError(fit.in_scan, person.vertices), 0.0015);
}

TEST(IntrinsicShape, RefusesEmptyScansAndAttributesThatNobodyHas) {
  const DatabaseSubject& person = SmallDatabase().subjects[36];
  EXPECT_THAT(MessageOf<DataError>([&] { FitTo({}, person.attributes); }), HasSubstr("empty"));
  BodyAttributes giant = person.attributes;
  giant.height_m = 1.2 * person.attributes.height_m;
  EXPECT_THAT(MessageOf<DataError>([&] { FitTo(MeshOf(person.vertices), giant); }),
              HasSubstr("m high"));
  BodyAttributes heavy = person.attributes;
  heavy.weight_kg = 400.0;
  EXPECT_THAT(MessageOf<ConfigError>([&] { FitTo(MeshOf(person.vertices), heavy); }),
              HasSubstr("standard deviations"));
}

}  // namespace
}  // namespace vitruvia
