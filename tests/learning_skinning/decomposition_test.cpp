#include "learning/skinning/decomposition.h"

#include <algorithm>
#include <stdexcept>

#include <gmock/gmock.h>

#include "learning/skinning/fit_errors.h"
#include "learning_skinning/planted.h"
#include "math/rigid.h"

namespace vitruvia::skinning {
namespace {

using testing::HasSubstr;

Decomposition Learn(const Planted& planted, const Settings& settings) {
  return Decompose(planted.examples, planted.labels, planted.candidates, settings);
}

void ExpectNeverRises(const Decomposition& result) {
  double before = result.start_rmse_m;
  for (const Alternation& alternation : result.alternations) {
    EXPECT_LE(alternation.rmse_m, before);
    before = alternation.rmse_m;
  }
}

TEST(Decompose, ExplainsWhatWasPlanted) {
  const Planted planted = Plant({});
  const Decomposition result = Learn(planted, {});
  EXPECT_GT(result.start_rmse_m, 0.005);
  EXPECT_LT(result.rmse_m, 1e-6);
  EXPECT_NEAR(result.rmse_m, SlowRmse(planted.examples, result.weights, result.poses), 1e-7);
  EXPECT_EQ(WeightsProblem(result.weights, 400, 5), "");
  ExpectNeverRises(result);
}

TEST(Decompose, PlainAlternationNeverRisesEither) {
  const Planted planted = Plant({.noise_m = 0.001});
  for (const TransformSolver solver :
       {TransformSolver::kClosedForm, TransformSolver::kLinearised}) {
    Settings settings;
    settings.transforms = solver;
    settings.joint_iterations = 0;
    settings.alternations = 60;
    const Decomposition result = Learn(planted, settings);
    ExpectNeverRises(result);
    EXPECT_LT(result.rmse_m, 0.0021);  // noise of √3 mm
  }
}

TEST(Decompose, NoiseIsNotExplainedByMoreThanTheUnknownsAllow) {
  const PlantedShape shape = {.vertices = 400, .poses = 30, .noise_m = 0.001};
  const Planted planted = Plant(shape);
  const double truth_m = SlowRmse(planted.examples, planted.weights, planted.bones);
  Settings settings;
  settings.alternations = 50;
  const Decomposition result = Learn(planted, settings);
  ExpectNeverRises(result);
  EXPECT_LE(result.rmse_m, truth_m);
  // At most three free weights for each vertex and six numbers for each bone and pose.
  const double unknowns = 3.0 * 400 + 6.0 * 5 * 30, equations = 3.0 * 400 * 30;
  EXPECT_GE(result.rmse_m, 0.98 * truth_m * std::sqrt(1.0 - unknowns / equations));
}

TEST(Decompose, IsTheSameForAnyNumberOfThreads) {
  const Planted planted = Plant({.noise_m = 0.0005});
  Settings settings;
  settings.threads = 1;
  const Decomposition one = Learn(planted, settings);
  for (const int threads : {2, 3, 7}) {
    settings.threads = threads;
    const Decomposition many = Learn(planted, settings);
    EXPECT_EQ(many.weights.bones, one.weights.bones);
    EXPECT_EQ(many.weights.weights, one.weights.weights);
    ASSERT_EQ(many.alternations.size(), one.alternations.size());
    EXPECT_EQ(many.rmse_m, one.rmse_m);
    for (std::size_t p = 0; p < one.poses.size(); ++p) {
      for (std::size_t b = 0; b < one.poses[p].size(); ++b) {
        EXPECT_EQ(many.poses[p][b].rotation, one.poses[p][b].rotation);
        EXPECT_EQ(many.poses[p][b].translation, one.poses[p][b].translation);
      }
    }
  }
}

TEST(Decompose, RigidPiecesStayRigid) {
  const Planted planted = Plant({.influences = 1});
  const Decomposition result = Learn(planted, {});
  EXPECT_LT(result.start_rmse_m, 1e-6);
  EXPECT_LT(result.rmse_m, 1e-6);
  for (std::size_t v = 0; v < planted.labels.size(); ++v) {
    EXPECT_EQ(result.weights.bones[v][0], planted.labels[v]);
    EXPECT_NEAR(result.weights.weights[v][0], 1.0f, 1e-4f);
  }
  for (std::size_t p = 0; p < planted.bones.size(); ++p) {
    for (std::size_t b = 0; b < planted.bones[p].size(); ++b) {
      EXPECT_LT((result.poses[p][b].rotation - planted.bones[p][b].rotation).norm(), 1e-4);
    }
  }
}

TEST(Decompose, DoesNotCareWhereTheBodyStands) {
  const Decomposition near = Learn(Plant({}), {});
  const Decomposition far = Learn(Plant({.where_m = Vector3d(20.0, -5.0, 8.0)}), {});
  EXPECT_LT(near.rmse_m, 1e-6);
  EXPECT_LT(far.rmse_m, 5e-6);  // floats resolve 2 µm at 20 m
}

TEST(Decompose, FollowsTheLimitOfInfluences) {
  const Planted planted = Plant({});
  double before_m = 1.0;
  for (int influences = 1; influences <= 3; ++influences) {
    Settings settings;
    settings.influences = influences;
    const Decomposition result = Learn(planted, settings);
    for (const auto& row : result.weights.weights) {
      EXPECT_EQ(std::count_if(row.begin() + influences, row.end(), [](float w) { return w > 0; }),
                0);
    }
    EXPECT_LT(result.rmse_m, before_m);
    before_m = result.rmse_m;
  }
}

TEST(Decompose, UsesCandidatesOnly) {
  Planted planted = Plant({});
  for (std::size_t b = 0; b < planted.candidates.size(); ++b) {
    planted.candidates[b] = {static_cast<std::uint8_t>(b)};
  }
  const Decomposition result = Learn(planted, {});
  for (std::size_t v = 0; v < planted.labels.size(); ++v) {
    EXPECT_EQ(result.weights.bones[v][0], planted.labels[v]);
    EXPECT_EQ(result.weights.weights[v][0], 1.0f);
  }
}

TEST(Decompose, BonesWithoutVerticesAreNoObstacle) {
  Planted planted = Plant({});
  planted.candidates.push_back({5});  // nobody's
  planted.candidates[2].push_back(5);
  const Decomposition result = Learn(planted, {});
  EXPECT_LT(result.rmse_m, 1e-6);
  ExpectNeverRises(result);
  for (const Rigidd& bone : {result.poses[0][5], result.poses[3][5]}) {
    EXPECT_TRUE(bone.rotation.allFinite() && bone.translation.allFinite());
  }
}

TEST(Decompose, OnePoseIsExplained) {
  const Planted planted = Plant({.poses = 1});
  const Decomposition result = Learn(planted, {});
  ExpectNeverRises(result);
  EXPECT_LT(result.rmse_m, 0.2 * result.start_rmse_m);
  EXPECT_EQ(WeightsProblem(result.weights, 400, 5), "");
}

TEST(Decompose, VerticesInOnePlaceGetTheSameWeights) {
  Planted planted = Plant({});
  Examples& examples = planted.examples;
  examples.rest.push_back(examples.rest[17]);
  for (auto& pose : examples.poses) pose.push_back(pose[17]);
  planted.labels.push_back(planted.labels[17]);
  const Decomposition result = Learn(planted, {});
  EXPECT_LT(result.rmse_m, 1e-6);
  EXPECT_EQ(result.weights.bones[400], result.weights.bones[17]);
  EXPECT_EQ(result.weights.weights[400], result.weights.weights[17]);
}

TEST(Decompose, ABoneOfOneVertexIsNoObstacle) {
  Planted planted = Plant({.bones = 4});
  std::replace(planted.labels.begin(), planted.labels.end(), std::uint8_t{3}, std::uint8_t{2});
  planted.labels[5] = 3;
  const Decomposition result = Learn(planted, {});
  ExpectNeverRises(result);
  EXPECT_EQ(WeightsProblem(result.weights, 400, 4), "");
}

TEST(Decompose, AStillBodyNeedsNoAlternation) {
  Planted planted = Plant({.poses = 3});
  for (auto& pose : planted.examples.poses) pose = planted.examples.rest;
  const Decomposition result = Learn(planted, {});
  EXPECT_LT(result.rmse_m, 1e-6);
  EXPECT_EQ(result.ending, Ending::kConverged);
}

TEST(Decompose, SaysWhyItEnded) {
  const Planted planted = Plant({.noise_m = 0.001});
  Settings settings;
  settings.alternations = 3;
  const Decomposition few = Learn(planted, settings);
  EXPECT_EQ(few.ending, Ending::kAlternationLimit);
  EXPECT_EQ(few.alternations.size(), 3u);
  settings.alternations = 0;
  const Decomposition none = Learn(planted, settings);
  EXPECT_TRUE(none.alternations.empty());
  EXPECT_NEAR(none.rmse_m, none.start_rmse_m, 1e-6);
  settings.alternations = 1000;
  const Decomposition many = Learn(planted, settings);
  EXPECT_EQ(many.ending, Ending::kConverged);
  EXPECT_LT(many.alternations.size(), 1000u);
}

std::string MisuseOf(const Planted& planted) {
  try {
    Learn(planted, {});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Decompose, RefusesExamplesThatDoNotFit) {
  Planted planted = Plant({});
  planted.examples.poses[2].pop_back();
  EXPECT_EQ(MisuseOf(planted), "Decompose: pose 2 has 399 vertices, the rest pose 400");
  planted = Plant({});
  planted.examples.poses[1][3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(MisuseOf(planted), "Decompose: pose 1: vertex 3 is not finite");
  planted = Plant({});
  planted.examples.poses.clear();
  EXPECT_EQ(MisuseOf(planted), "Decompose: there are no poses");
  planted = Plant({});
  planted.labels[7] = 9;
  EXPECT_EQ(MisuseOf(planted), "Decompose: vertex 7: label 9, but there are 5 bones");
  planted = Plant({});
  planted.candidates[1] = {0, 2};
  EXPECT_THAT(MisuseOf(planted), HasSubstr("bone 1 is no candidate of its own label"));
  planted = Plant({});
  planted.candidates[1].push_back(5);
  EXPECT_THAT(MisuseOf(planted), HasSubstr("label 1 may follow bone 5, but there are 5 bones"));
}

TEST(FitTransforms, FindsThePlantedOnesForThePlantedWeights) {
  const Planted planted = Plant({});
  const FittedTransforms fitted = FitTransforms(planted.examples, planted.weights, 5, 2);
  EXPECT_LT(fitted.rmse_m, 1e-6);
  for (std::size_t p = 0; p < planted.bones.size(); ++p) {
    for (std::size_t b = 0; b < planted.bones[p].size(); ++b) {
      EXPECT_LT((fitted.poses[p][b].rotation - planted.bones[p][b].rotation).norm(), 1e-4);
    }
  }
  SkinWeights rigid = planted.weights;
  for (auto& row : rigid.weights) row = {1.0f, 0.0f, 0.0f, 0.0f};
  const FittedTransforms worse = FitTransforms(planted.examples, rigid, 5, 2);
  EXPECT_GT(worse.rmse_m, 0.005);
  EXPECT_NEAR(worse.rmse_m, SlowRmse(planted.examples, rigid, worse.poses), 1e-6);
}

TEST(VertexErrors, AreTheDistancesOfThatPoseAndVertex) {
  Planted planted = Plant({.vertices = 20, .poses = 3});
  planted.examples.poses[2][7] += Vector3f(0.03f, 0.0f, 0.04f);
  const auto errors = VertexErrors(planted.examples, planted.weights, planted.bones);
  ASSERT_EQ(errors.size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t v = 0; v < 20; ++v) {
      EXPECT_NEAR(errors[p][v], p == 2 && v == 7 ? 0.05f : 0.0f, 1e-6f);
    }
  }
}

}  // namespace
}  // namespace vitruvia::skinning
