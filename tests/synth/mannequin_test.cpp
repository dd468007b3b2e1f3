#include "synth/bodies/mannequin.h"

#include <algorithm>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body_measures.h"
#include "config/json_settings.h"
#include "core/error.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "search/kd_tree.h"
#include "synth/bodies/mannequin_score.h"
#include "synth/bodies/mannequin_tables.h"
#include "synth/bodies/refiner.h"

namespace vitruvia {
namespace {

using mannequin::Girth;
using mannequin::Survey;
using mannequin::SurveyTable;
using testing::HasSubstr;

constexpr RefinementSettings kTemplate{.subdivisions = kMannequinSteps};

BodySettings Mannequin(Sex sex, double height_m, double weight_kg) {
  BodySettings settings;
  settings.sex = sex;
  settings.height_m = height_m;
  settings.weight_kg = weight_kg;
  return settings;
}

BodySettings MeanPerson(Sex sex) {
  return Mannequin(sex, Survey(sex).stature_m, Survey(sex).weight_kg);
}

struct Someone {
  BodySettings settings;
  ControlBody control;
  BodyModel body;  // at kTemplate
};

// Both sexes, from the thinnest to the heaviest admitted, small and tall.
const std::vector<Someone>& Crowd() {
  static const std::vector<Someone> crowd = [] {
    std::vector<Someone> people;
    for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
      for (const auto& [height_m, weight_kg] : {std::pair{1.2, 20.0},
                                                {1.2, 48.3},
                                                {1.6, 110.0},
                                                {1.75, 40.3},
                                                {1.75, 72.0},
                                                {1.75, 150.0},
                                                {2.1, 70.0},
                                                {2.1, 160.0}}) {
        const BodySettings settings = Mannequin(sex, height_m, weight_kg);
        const ControlBody control = MakeControlBody(settings);
        people.push_back({settings, control, Refine(control, kTemplate)});
      }
    }
    return people;
  }();
  return crowd;
}

std::string NameOf(const BodySettings& person) {
  return fmt::format("{} {} m {} kg", person.sex == Sex::kMale ? "man" : "woman", person.height_m,
                     person.weight_kg);
}

std::pair<Vector3f, Vector3f> Box(const std::vector<Vector3f>& vertices) {
  Vector3f low = vertices.front(), high = vertices.front();
  for (const Vector3f& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return {low, high};
}

Vector3d JointOf(const BodyModel& body, const char* bone) {
  return body.skeleton.joints[FindBone(bone)];
}

TEST(Mannequin, IsOneClosedSurfaceThatFacesOutwardsAndNeverCutsItself) {
  for (const auto& [person, control, body] : Crowd()) {
    SCOPED_TRACE(NameOf(person));
    const MeshReport report = InspectMesh(body.rest);
    EXPECT_EQ(report.problem, "");
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.euler_characteristic, 2);
    EXPECT_GT(EnclosedVolume(body.rest), 0.0);
    EXPECT_EQ(CountSelfIntersections(body.rest), 0);
    CheckBodyModel(body, "mannequin");
  }
}

TEST(Mannequin, HasTheTrackingTemplatesDetail) {
  const ControlBody control = MakeControlBody(MeanPerson(Sex::kMale));
  EXPECT_EQ(control.cage.vertices.size(), 400u);
  EXPECT_EQ(control.cage.quads.size(), 398u);
  const BodyModel body = Refine(control, DefaultTemplateRefinement(BodySource::kMannequin));
  EXPECT_EQ(body.rest.vertices.size(), 6370u);  // paper A's: 6,252
  EXPECT_EQ(body.rest.triangles.size(), 12736u);
  EXPECT_NEAR(static_cast<double>(body.rest.vertices.size()), 6252.0, 0.03 * 6252.0);
  EXPECT_EQ(Refine(control, {.subdivisions = 3}).rest.vertices.size(), 25474u);
}

TEST(Mannequin, IsAsHighAndAsHeavyAsAsked) {
  for (const auto& [person, control, template_body] : Crowd()) {
    SCOPED_TRACE(NameOf(person));
    for (const int subdivisions : {2, 3}) {
      const BodyModel body =
          subdivisions == 2 ? template_body : Refine(control, {.subdivisions = subdivisions});
      const auto [low, high] = Box(body.rest.vertices);
      EXPECT_NEAR(low.y(), 0.0, 0.001);
      EXPECT_NEAR(high.y() - low.y(), person.height_m, 0.002);
      EXPECT_NEAR(EnclosedVolume(body.rest) * BodyDensity(person.sex), person.weight_kg,
                  0.01 * person.weight_kg);
      EXPECT_EQ(body.attributes.height_m, person.height_m);
      EXPECT_EQ(body.attributes.weight_kg, person.weight_kg);
      EXPECT_EQ(body.attributes.sex, person.sex);
    }
  }
}

TEST(Mannequin, HasOneTopologyForEverybody) {
  const Someone& first = Crowd().front();
  for (const Someone& other : Crowd()) {
    EXPECT_EQ(other.control.cage.quads, first.control.cage.quads);
    EXPECT_EQ(other.control.weights, first.control.weights);
    EXPECT_EQ(other.body.rest.triangles, first.body.rest.triangles);
  }
}

TEST(Mannequin, DiffersBetweenSubjects) {
  const auto volume = [](Sex sex, double weight_kg) {
    return EnclosedVolume(Refine(MakeControlBody(Mannequin(sex, 1.7, weight_kg)), kTemplate).rest);
  };
  EXPECT_LT(volume(Sex::kMale, 60.0), 0.81 * volume(Sex::kMale, 75.0));
  // Of one height and weight, she has the broader hips for her waist.
  const auto waist_to_hip = [](Sex sex) {
    const BodyModel body = Refine(MakeControlBody(Mannequin(sex, 1.7, 68.0)), kTemplate);
    const auto all = [](const Vector3d&) { return true; };
    return TapeGirth(body.rest, {0, 0.602 * 1.7, 0}, Vector3d::UnitY(), all) /
           TapeGirth(body.rest, {0, 0.508 * 1.7, 0}, Vector3d::UnitY(), all);
  };
  EXPECT_LT(waist_to_hip(Sex::kFemale) + 0.04, waist_to_hip(Sex::kMale));
}

TEST(Mannequin, MirrorsExactly) {
  const ControlBody control = MakeControlBody(Mannequin(Sex::kFemale, 1.65, 60.0));
  const auto mirrored_weights = [](const Eigen::RowVectorXf& row) {
    Eigen::RowVectorXf result(kBoneCount);
    for (int bone = 0; bone < kBoneCount; ++bone) result[Bones()[bone].mirror] = row[bone];
    return result;
  };
  const auto& vertices = control.cage.vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector3f mirrored(-vertices[v].x(), vertices[v].y(), vertices[v].z());
    const auto other = std::find(vertices.begin(), vertices.end(), mirrored);
    ASSERT_NE(other, vertices.end()) << "cage vertex " << v;
    EXPECT_EQ(Eigen::RowVectorXf(control.weights.row(other - vertices.begin())),
              mirrored_weights(control.weights.row(v)));
  }
  // Refined, sums of floats come in another order on the other side.
  const BodyModel body = Refine(control, {.subdivisions = 2, .weight_diffusion = 2});
  std::vector<Vector3f> mirrored = body.rest.vertices;
  for (Vector3f& v : mirrored) v.x() = -v.x();
  KdTree tree;
  tree.Build(body.rest.vertices);
  std::vector<KdTree::Neighbor> partners;
  tree.FindNearest(mirrored, 1e-6f, partners);
  const Eigen::MatrixXf weights = Dense(body.weights, kBoneCount);
  for (std::size_t v = 0; v < partners.size(); ++v) {
    ASSERT_GE(partners[v].index, 0) << "refined vertex " << v;
    EXPECT_LT(
        (weights.row(partners[v].index) - mirrored_weights(weights.row(v))).cwiseAbs().maxCoeff(),
        1e-5f);
  }
}

TEST(Mannequin, HoldsItsJointsInside) {
  for (const auto& [person, control, body] : Crowd()) {
    SCOPED_TRACE(NameOf(person));
    for (int bone = 0; bone < kBoneCount; ++bone) {
      EXPECT_NEAR(WindingNumber(body.rest, body.skeleton.joints[bone]), 1.0, 1e-3)
          << Bones()[bone].joint;
      const Vector3d& joint = body.skeleton.joints[bone];
      const Vector3d& other = body.skeleton.joints[Bones()[bone].mirror];
      EXPECT_EQ(other, Vector3d(Bones()[bone].mirror == bone ? joint.x() : -joint.x(), joint.y(),
                                joint.z()));
    }
  }
}

TEST(Mannequin, StandsInTheTPose) {
  const BodyModel body = Refine(MakeControlBody(MeanPerson(Sex::kFemale)), kTemplate);
  const auto [low, high] = Box(body.rest.vertices);
  const auto extreme = [&](int axis) {
    return *std::max_element(
        body.rest.vertices.begin(), body.rest.vertices.end(),
        [&](const Vector3f& a, const Vector3f& b) { return a[axis] < b[axis]; });
  };
  const double stature = Survey(Sex::kFemale).stature_m;
  // Hands furthest to the sides, at shoulder height, and a span of 1.03 statures as surveyed.
  EXPECT_NEAR(extreme(0).y(), JointOf(body, "left_upper_arm").y(), 0.02);
  EXPECT_NEAR(high.x() - low.x(), 1.033 * stature, 0.015 * stature);
  // Toes furthest to the front but for the breast.
  EXPECT_LT(extreme(2).y(), 0.05);
  // Joints at their published heights.
  EXPECT_NEAR(JointOf(body, "left_thigh").y(), 0.530 * stature, 0.003);
  EXPECT_NEAR(JointOf(body, "left_shin").y(), 0.285 * stature, 0.003);
  EXPECT_NEAR(JointOf(body, "left_foot").y(), 0.039 * stature, 0.003);
  // The vertices of the left hand's bone lie beyond the wrist.
  const Eigen::MatrixXf weights = Dense(body.weights, kBoneCount);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    if (weights(v, FindBone("left_hand")) > 0.99f) {
      EXPECT_GT(body.rest.vertices[v].x(), JointOf(body, "left_hand").x() - 0.03);
    }
  }
}

TEST(Mannequin, HasTheSurveysGirthsAtTheSurveysMeans) {
  constexpr double kTolerance = 0.06;  // of the mean; the survey's deviations are 3 to 12 %
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    const SurveyTable& survey = Survey(sex);
    const BodyModel body = Refine(MakeControlBody(MeanPerson(sex)), kTemplate);
    const double stature = survey.stature_m;
    const Vector3d up = Vector3d::UnitY(), along_arm = Vector3d::UnitX();
    const auto trunk = [](const Vector3d&) { return true; };
    const auto left = [](const Vector3d& p) { return p.x() > 0.0; };
    const auto expect = [&](const char* name, const Girth& girth, const Vector3d& at,
                            const Vector3d& normal, const auto& keep, double factor = 1.0) {
      EXPECT_NEAR(TapeGirth(body.rest, at, normal, keep), factor * girth.mean_m,
                  kTolerance * factor * girth.mean_m)
          << name << (sex == Sex::kMale ? " of a man" : " of a woman");
    };
    const auto level = [&](double height) { return Vector3d(0.0, height * stature, 0.0); };
    expect("head", survey.head, level(0.945), up, trunk);
    // Across the neck, which leans forwards.
    expect("neck", survey.neck, level(0.876) - Vector3d(0, 0, 0.02), {0.0, 1.0, 0.46},
           [](const Vector3d& p) { return std::abs(p.x()) < 0.12; });
    expect("chest", survey.chest, level(0.725), up, trunk);
    expect("waist", survey.waist, level(0.602), up, trunk);
    expect("buttock", survey.buttock, level(0.508), up, trunk);
    expect("thigh", survey.thigh, level(0.452), up, left);
    expect("calf", survey.calf, level(0.200), up, left);
    expect("ankle", survey.ankle, level(0.070), up, left);
    const Vector3d shoulder = JointOf(body, "left_upper_arm"),
                   elbow = JointOf(body, "left_forearm");
    const Vector3d wrist = JointOf(body, "left_hand");
    expect("biceps", survey.biceps_flexed, shoulder + 0.55 * (elbow - shoulder), along_arm, trunk,
           mannequin::kRelaxedBiceps);
    expect("forearm", survey.forearm_flexed, elbow + 0.24 * (wrist - elbow), along_arm, trunk,
           mannequin::kRelaxedForearm);
    expect("wrist", survey.wrist, wrist - 0.01 * along_arm, along_arm, trunk);
  }
}

TEST(Mannequin, HasValidWeightsThatFollowTheBones) {
  const ControlBody control = MakeControlBody(MeanPerson(Sex::kMale));
  for (Eigen::Index v = 0; v < control.weights.rows(); ++v) {
    EXPECT_NEAR(control.weights.row(v).sum(), 1.0f, 1e-6f) << "cage vertex " << v;
    EXPECT_GE(control.weights.row(v).minCoeff(), 0.0f);
    EXPECT_LE((control.weights.row(v).array() > 0.0f).count(), kMaxInfluences);
  }
  const BodyModel body = Refine(control, kTemplate);
  EXPECT_EQ(WeightsProblem(body.weights, body.rest.vertices.size(), kBoneCount), "");
  // No vertex hangs on a bone of the other side's limb: the crotch's share in both thighs fades.
  const Eigen::MatrixXf weights = Dense(body.weights, kBoneCount);
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    if (body.rest.vertices[v].x() < 0.09f) continue;
    for (const char* bone : {"right_thigh", "right_shin", "right_foot", "right_upper_arm"}) {
      EXPECT_LT(weights(v, FindBone(bone)), 0.02f) << bone << " at vertex " << v;
    }
  }
}

TEST(Mannequin, KeepsItsVolumeWhenKneesAndElbowsBend) {
  const BodyModel body = Refine(MakeControlBody(MeanPerson(Sex::kMale)), kTemplate);
  JointPose pose = JointPose::Rest(body.skeleton);
  const double right_angle = std::numbers::pi / 2.0;
  for (const char* knee : {"left_shin", "right_shin"}) {
    pose.local_rotations[FindBone(knee)] = ExpSo3<double>({right_angle, 0.0, 0.0});
  }
  pose.local_rotations[FindBone("left_forearm")] = ExpSo3<double>({0.0, -right_angle, 0.0});
  pose.local_rotations[FindBone("right_forearm")] = ExpSo3<double>({0.0, right_angle, 0.0});
  TriangleMesh posed = body.rest;
  SkinLinear(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose),
             posed.vertices);
  EXPECT_NEAR(EnclosedVolume(posed) / EnclosedVolume(body.rest), 1.0, 0.02);
}

TEST(Mannequin, ScoreIsThatOfBisectionInHalfAsManyTrials) {
  double trials = 0.0;
  const auto volume_at = [&trials](double score) {
    ++trials;
    const double girth = 1.0 + 0.06 * std::max(score, -6.5);  // cut off where no girth is left
    return 0.06 * girth * girth + 0.01 * girth;
  };
  const auto bisected = [&](double volume_m3) {
    double low = mannequin::kLeastScore, high = mannequin::kGreatestScore, score = 0.0;
    for (int step = 0; step < mannequin::kScoreSteps; ++step) {
      score = 0.5 * (low + high);
      (volume_at(score) < volume_m3 ? low : high) = score;
    }
    return score;
  };
  int people = 0;
  double trials_of_search = 0.0;
  for (double volume_m3 = 0.02; volume_m3 < 0.2; volume_m3 += 3.7e-5, ++people) {
    const double expected = bisected(volume_m3);
    trials = 0.0;
    EXPECT_EQ(mannequin::ScoreOfVolume(volume_at, volume_m3), expected) << volume_m3;
    trials_of_search += trials;
  }
  // Volumes that a tried score has exactly, and such as no score has.
  for (const double volume_m3 : {volume_at(1.0), volume_at(-3.0), volume_at(8.0), 0.0, 1.0})
    EXPECT_EQ(mannequin::ScoreOfVolume(volume_at, volume_m3), bisected(volume_m3)) << volume_m3;
  EXPECT_LT(trials_of_search / people, 13.0);
}

TEST(Mannequin, RefusesWhatNoBodyIs) {
  EXPECT_THROW(MakeControlBody(Mannequin(Sex::kMale, 2.0, 40.0)), ConfigError);
  EXPECT_THROW(MakeControlBody(Mannequin(Sex::kFemale, 1.2, 150.0)), ConfigError);
  try {
    ReadSettings<BodySettings>(Json::parse(R"({"height_m": 2.0, "weight_kg": 40})"),
                               {"s.json", ""});
    FAIL() << "expected a ConfigError";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.json"));
    EXPECT_THAT(error.what(),
                HasSubstr("no mannequin of height 2 m weighs 40 kg; expected a weight "
                          "of 60.0 … 224.0 kg at that height"));
  }
  EXPECT_THROW(ReadSettings<BodySettings>(Json::parse(R"({"height_m": 2.3, "weight_kg": 90})"),
                                          {"s.json", ""}),
               ConfigError);
}

TEST(Refine, WithoutStepsGivesTheCageAsTriangles) {
  const ControlBody control = MakeControlBody(MeanPerson(Sex::kFemale));
  const BodyModel body = Refine(control, {});
  EXPECT_EQ(body.rest.vertices, control.cage.vertices);
  EXPECT_EQ(body.rest.triangles.size(), 2 * control.cage.quads.size());
  EXPECT_LT((Dense(body.weights, kBoneCount) - control.weights).cwiseAbs().maxCoeff(), 1e-6f);
}

TEST(Refine, DiffusionMovesWeightsOnlyAndSpreadsThem) {
  const ControlBody control = MakeControlBody(MeanPerson(Sex::kFemale));
  const BodyModel sharp = Refine(control, kTemplate);
  const BodyModel soft = Refine(control, {.subdivisions = 2, .weight_diffusion = 8});
  EXPECT_EQ(soft.rest.vertices, sharp.rest.vertices);
  EXPECT_EQ(WeightsProblem(soft.weights, soft.rest.vertices.size(), kBoneCount), "");
  const auto rigid = [](const BodyModel& body) {
    return std::count_if(body.weights.weights.begin(), body.weights.weights.end(),
                         [](const auto& w) { return w[0] == 1.0f; });
  };
  EXPECT_LT(rigid(soft), rigid(sharp));
}

TEST(Refine, RefinerGivesEachBodyWhatRefiningItAloneGives) {
  const Someone &first = Crowd().front(), &last = Crowd().back();
  const Refiner refiner(first.control.cage, kTemplate);
  EXPECT_EQ(refiner.Vertices(last.control), last.body.rest.vertices);
  EXPECT_EQ(refiner.Refined(last.control).rest.vertices, last.body.rest.vertices);
  EXPECT_EQ(refiner.Refined(last.control).weights.weights, last.body.weights.weights);
  const RefinementSettings decimated{.subdivisions = 1, .target_vertices = 500};
  EXPECT_EQ(Refiner(first.control.cage, decimated).Vertices(last.control),
            Refine(last.control, decimated).rest.vertices);
  ControlBody other = first.control;
  std::swap(other.cage.quads.front(), other.cage.quads.back());
  EXPECT_THROW(refiner.Vertices(other), std::invalid_argument);
}

TEST(Refine, RefusesWeightsThatDoNotFitTheCage) {
  ControlBody control = MakeControlBody(MeanPerson(Sex::kFemale));
  control.weights.conservativeResize(10, kBoneCount);
  EXPECT_THROW(Refine(control, {}), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
