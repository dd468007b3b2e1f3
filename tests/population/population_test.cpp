// Populations and databases: what is drawn, that it can be drawn again, and that the examples are
// not what linear blend skinning makes.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "math/statistics.h"
#include "synth/bodies/mannequin.h"
#include "synth/population/make_database.h"

namespace vitruvia {
namespace {

DatabaseSettings SmallSettings() {
  DatabaseSettings settings;
  settings.population.subjects = 12;
  settings.mesh.subdivisions = 1;
  settings.subjects_with_poses = 2;
  settings.poses.poses = 3;
  return settings;
}

TEST(Population, SubjectsDoNotDependOnWhoElseWasAskedFor) {
  Population forwards({}), alone({});
  forwards.Subject(0);
  forwards.Subject(1);
  EXPECT_EQ(forwards.Subject(2).cage.vertices, alone.Subject(2).cage.vertices);
  EXPECT_NE(alone.Subject(2).cage.vertices, alone.Subject(3).cage.vertices);
}

TEST(Population, HasTheStatedDistributions) {
  PopulationSettings settings;
  settings.male_share = 0.25;
  Population population(settings);
  std::vector<double> indices, heights_of_men;
  int men = 0;
  constexpr int kPeople = 120;
  for (int i = 0; i < kPeople; ++i) {
    const BodyAttributes a = population.Subject(i).attributes;
    indices.push_back(a.weight_kg / (a.height_m * a.height_m));
    if (a.sex == Sex::kMale) {
      ++men;
      heights_of_men.push_back(a.height_m);
    }
  }
  // Five standard errors each.
  EXPECT_NEAR(men, 0.25 * kPeople, 5.0 * std::sqrt(0.25 * 0.75 * kPeople));
  EXPECT_NEAR(Mean(indices), 26.0, 5.0 * 4.0 / std::sqrt(kPeople));
  EXPECT_NEAR(Mean(heights_of_men), 1.756, 5.0 * 0.069 / std::sqrt(men));
}

TEST(Database, SameSettingsSameDatabase) {
  const BodyDatabase a = MakeDatabase(SmallSettings()), b = MakeDatabase(SmallSettings());
  ASSERT_EQ(a.subjects.size(), 12u);
  EXPECT_EQ(a.subjects[5].vertices, b.subjects[5].vertices);
  EXPECT_EQ(a.examples[1].poses[2], b.examples[1].poses[2]);
  EXPECT_EQ(a.reference.rest.vertices, a.subjects[MostAverage(a.subjects)].vertices);
}

TEST(Database, AttributesAreThoseOfTheSurface) {
  const BodyDatabase database = MakeDatabase(SmallSettings());
  for (const DatabaseSubject& subject : database.subjects) {
    const TriangleMesh mesh{subject.vertices, database.reference.rest.triangles};
    // One subdivision less than the one at which a mannequin's weight is exact.
    EXPECT_NEAR(EnclosedVolume(mesh) * BodyDensity(subject.attributes.sex),
                subject.attributes.weight_kg, 0.03 * subject.attributes.weight_kg);
  }
}

TEST(Database, ExamplesDifferFromLinearSkinningMostAtBentElbowsAndKnees) {
  DatabaseSettings settings = SmallSettings();
  settings.poses.weight_diffusion = 0;
  Population population(settings.population);
  const BodyModel body = Refine(population.Subject(0), settings.mesh);
  JointPose pose = JointPose::Rest(body.skeleton);
  const auto forearm = static_cast<std::size_t>(BoneId::kLeftForearm);
  pose.local_rotations[forearm] = ExpSo3<double>({0.0, -1.5, 0.0});
  RandomStream random(1, "test");
  const std::vector<Vector3f> made = Deform(settings.poses, body, pose, random);
  std::vector<Vector3f> linear;
  SkinLinear(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose), linear);
  const Vector3f elbow = body.skeleton.joints[forearm].cast<float>();
  double near = 0.0, far = 0.0;
  for (std::size_t v = 0; v < made.size(); ++v) {
    const double difference = (made[v] - linear[v]).norm();
    ((body.rest.vertices[v] - elbow).norm() < 0.1f ? near : far) =
        std::max((body.rest.vertices[v] - elbow).norm() < 0.1f ? near : far, difference);
  }
  EXPECT_GT(near, 0.01);
  EXPECT_LT(far, 0.7 * near);
}

TEST(Database, RestPoseWithoutNoiseIsTheRestSurface) {
  const DatabaseSettings settings = SmallSettings();
  Population population(settings.population);
  const BodyModel body = Refine(population.Subject(0), settings.mesh);
  RandomStream random(1, "test");
  const auto made = Deform(settings.poses, body, JointPose::Rest(body.skeleton), random);
  for (std::size_t v = 0; v < made.size(); ++v)
    EXPECT_LT((made[v] - body.rest.vertices[v]).norm(), 1e-5f);
}

TEST(Database, RefusesDistributionsThatMissEveryMannequin) {
  PopulationSettings settings;
  settings.body_mass_index = 60.0;
  settings.body_mass_index_deviation = 0.0;
  Population population(settings);
  EXPECT_THROW(population.Subject(0), ConfigError);
}

}  // namespace
}  // namespace vitruvia
