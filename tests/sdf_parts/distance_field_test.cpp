#include "methods/sdf_parts/distance_field.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "methods/sdf_parts/part.h"
#include "support/shapes.h"
#include "synth/bodies/body_source.h"

namespace vitruvia::sdf_parts {
namespace {

constexpr double kCell_m = 0.02, kRadius_m = 0.15;

TriangleMesh SmallSphere() {
  TriangleMesh mesh = Triangulated(shapes::Sphere(4));
  for (Vector3f& v : mesh.vertices) v *= static_cast<float>(kRadius_m);
  return mesh;
}

Vector3f Somewhere(RandomStream& random, double range) {
  return Vector3d(random.Uniform(-range, range), random.Uniform(-range, range),
                  random.Uniform(-range, range))
      .cast<float>();
}

// Along each axis the gradient of the interpolation is that of |x| − R half a cell off at most,
// which along x makes h / √3|x| for cells of side h.
TEST(DistanceField, OfASphereIsTheAnalyticOne) {
  const DistanceField field(SmallSphere(), kCell_m, 0.1);
  RandomStream random(1, "points");
  for (int i = 0; i < 2000; ++i) {
    const Vector3f x = Somewhere(random, 0.24);
    ASSERT_TRUE(field.Covers(x));
    const double radius_m = double{x.norm()};
    if (radius_m < 2.0 * kCell_m) continue;  // the distance has a tip in the middle
    const DistanceField::Sample sample = field.At(x);
    EXPECT_NEAR(sample.distance_m, radius_m - kRadius_m, 0.1 * kCell_m) << x.transpose();
    if (std::abs(radius_m - kRadius_m) > 2.0 * kCell_m) continue;
    const double longest = kCell_m / (std::sqrt(3.0) * (radius_m - kCell_m));
    EXPECT_NEAR(double{sample.gradient.dot(x.normalized())}, 1.0, longest) << x.transpose();
    EXPECT_GT(sample.gradient.normalized().dot(x.normalized()), 0.99f);
  }
  EXPECT_FALSE(field.Covers({0.26f, 0.0f, 0.0f}));
}

TEST(DistanceField, GradientIsThatOfTheInterpolation) {
  constexpr float kStep = 1e-3f;
  const DistanceField field(SmallSphere(), kCell_m, 0.1);
  // Inside a cell, where the interpolation is a polynomial.
  const Vector3f x(0.1034f, 0.0671f, -0.0432f);
  for (int k = 0; k < 3; ++k) {
    const Vector3f step = kStep * Vector3f::Unit(k);
    EXPECT_NEAR(field.At(x).gradient[k],
                (field.At(x + step).distance_m - field.At(x - step).distance_m) / (2.0f * kStep),
                1e-3);
  }
}

TEST(Parts, AreClosedAndHoldTheWholeSkin) {
  const BodyModel body = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  const std::vector<Part> parts = CutIntoParts(body, 0.3);
  ASSERT_EQ(parts.size(), std::size_t{kBoneCount});
  double volume = 0.0;
  for (const Part& part : parts) {
    std::map<std::pair<int, int>, int> edges;
    for (const Triangle& t : part.mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        ++edges[{t[k], t[(k + 1) % 3]}];
        --edges[{t[(k + 1) % 3], t[k]}];
      }
    }
    for (const auto& [edge, sum] : edges) EXPECT_EQ(sum, 0) << Bones()[part.bone].name;
    EXPECT_GT(EnclosedVolume(part.mesh), 0.0);
    volume += EnclosedVolume(part.mesh);
  }
  // They overlap at the joints.
  EXPECT_GT(volume, EnclosedVolume(body.rest));
  EXPECT_LT(volume, 1.6 * EnclosedVolume(body.rest));
}

// Points of the skin lie on the surface of some part.
TEST(Parts, FieldsVanishOnTheSkin) {
  const BodyModel body = Refine(MakeControlBody(BodySettings{}), {.subdivisions = 1});
  std::vector<DistanceField> fields;
  for (const Part& part : CutIntoParts(body, 0.3)) fields.emplace_back(part.mesh, kCell_m, 0.1);
  double sum = 0.0, count = 0.0;
  for (std::size_t v = 0; v < body.rest.vertices.size(); v += 5) {
    float least = 1.0f;
    for (const DistanceField& field : fields) {
      const Vector3f& x = body.rest.vertices[v];
      if (field.Covers(x)) least = std::min(least, field.At(x).distance_m);
    }
    sum += std::abs(double{least});
    count += 1.0;
  }
  EXPECT_LT(sum / count, 0.2 * kCell_m);
}

}  // namespace
}  // namespace vitruvia::sdf_parts
