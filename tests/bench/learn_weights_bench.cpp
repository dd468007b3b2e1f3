// Skinning decomposition on the tracking template of the mannequin, 70 poses by linear blend
// skinning, from rigid labels.
#include <cmath>
#include <ctime>

#include "bench/bench.h"
#include "core/random.h"
#include "learning/skinning/decomposition.h"
#include "synth/bodies/body_source.h"
#include "synth/motions/motion.h"

namespace vitruvia::bench {
namespace {

using namespace skinning;

constexpr const char* kMotions[] = {"arm_wave",     "boxing", "calisthenics", "crouch",
                                    "jumping_jack", "kick",   "sit_down"};
constexpr int kPosesPerMotion = 10;
constexpr int kVertices = 6252;  // of paper A's tracking mesh
constexpr double kNoise_m = 0.001;
constexpr double kMmPerM = 1000.0, kMsPerS = 1000.0;
constexpr int kWeightsRepeats = 3;

std::vector<JointPose> SampledPoses(const Skeleton& skeleton) {
  std::vector<JointPose> poses;
  for (const char* name : kMotions) {
    MotionSettings settings;
    settings.file = std::filesystem::path(VITRUVIA_SOURCE_DIR) / "configs/motions" /
                    (std::string(name) + ".json");
    const auto motion = LoadMotion(settings, skeleton);
    const double begin_s = settings.rest_s + settings.blend_s;
    for (int i = 0; i < kPosesPerMotion; ++i) {
      const double share = (i + 0.5) / kPosesPerMotion;
      poses.push_back(motion->At(begin_s + share * (motion->duration_s() - begin_s)).pose);
    }
  }
  return poses;
}

Examples LinearlySkinned(const BodyModel& body) {
  Examples examples{body.rest.vertices, {}};
  for (const JointPose& pose : SampledPoses(body.skeleton)) {
    SkinLinear(body.rest.vertices, body.weights, ForwardKinematics(body.skeleton, pose),
               examples.poses.emplace_back());
  }
  return examples;
}

// Adds noise to every coordinate of every pose; returns its root mean square length, metres.
double AddNoise(Examples& examples) {
  RandomStream random(1, "noise");
  double sum = 0.0;
  for (auto& pose : examples.poses) {
    for (Vector3f& vertex : pose) {
      const Vector3d noise(random.Normal(0.0, kNoise_m), random.Normal(0.0, kNoise_m),
                           random.Normal(0.0, kNoise_m));
      vertex += noise.cast<float>();
      sum += noise.squaredNorm();
    }
  }
  return std::sqrt(sum / static_cast<double>(examples.poses.size() * examples.rest.size()));
}

Decomposition Learn(const BodyModel& body, const Examples& examples, int alternations) {
  Settings settings;
  settings.alternations = alternations;
  settings.least_gain = 0.0;
  const Labels labels = HeaviestBones(body.weights);
  const BoneGraph candidates = CandidateBones(labels, body.rest.triangles, kBoneCount, settings);
  return Decompose(examples, labels, candidates, settings);
}

double MedianAlternationMs(const Decomposition& result) {
  std::vector<double> times_ms;
  for (const Alternation& alternation : result.alternations)
    times_ms.push_back(alternation.time_ms);
  return Median(times_ms);
}

}  // namespace

std::vector<Row> LearnWeights() {
  RefinementSettings refinement = DefaultTemplateRefinement(BodySource::kMannequin);
  refinement.target_vertices = kVertices;
  const BodyModel body = Refine(MakeControlBody({}), refinement);
  Examples examples = LinearlySkinned(body);
  const Decomposition after_100 = Learn(body, examples, 100);
  Decomposition after_20;
  const std::clock_t before = std::clock();
  const double all_ms = MedianMs(kWeightsRepeats, [&] { after_20 = Learn(body, examples, 20); });
  const double processor_ms = kMsPerS * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const double noise_m = AddNoise(examples);
  const Decomposition noisy = Learn(body, examples, 20);
  return {
      {"learn_weights_ms_per_alternation", MedianAlternationMs(after_100), "ms"},
      {"learn_weights_ms", all_ms, "ms"},
      {"learn_weights_processor_ms", processor_ms / kWeightsRepeats, "ms"},
      {"learn_weights_alternations", static_cast<double>(after_20.alternations.size()), "1"},
      {"learn_weights_start_rmse_mm", kMmPerM * after_100.start_rmse_m, "mm"},
      {"learn_weights_rmse_mm_after_20", kMmPerM * after_20.rmse_m, "mm"},
      {"learn_weights_rmse_mm_after_100", kMmPerM * after_100.rmse_m, "mm"},
      {"learn_weights_noisy_rmse_of_noise", noisy.rmse_m / noise_m, "1"},
  };
}

}  // namespace vitruvia::bench
