#include "synth/sensor/joint_stand_in.h"

#include <limits>

#include <fmt/format.h>

#include "core/random.h"

namespace vitruvia {

void JointStandInSettings::Describe(Fields& f) {
  f.Number("deviation_m", deviation_m,
           {.meaning = "standard deviation of each coordinate of a joint",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "better than a Kinect's, whose joints are off by some centimetres"});
  f.Number("depth_bias_m", depth_bias_m,
           {.meaning = "bias of the joints' depth along the line of sight",
            .unit = "m",
            .min = -1.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("outlier_share", outlier_share,
           {.meaning =
                "share of the joints that are outliers, uniform in a cube round the true position",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("outlier_reach_m", outlier_reach_m,
           {.meaning = "half edge length of the outliers' cube",
            .unit = "m",
            .min = 0.0,
            .max = 2.0,
            .origin = Origin::kGuessed});
  f.Integer("seed", seed, {.meaning = "seed of all random choices", .min = 0});
}

std::string StandInDescription(const JointStandInSettings& s) {
  return fmt::format(
      "true joints with noise of {:g} m on each coordinate, {:g} m farther along the line of "
      "sight, {:g} % of them anywhere within {:g} m, seed {}",
      s.deviation_m, s.depth_bias_m, 100.0 * s.outlier_share, s.outlier_reach_m, s.seed);
}

std::vector<Vector3d> StandInJoints(const JointStandInSettings& settings,
                                    const std::vector<Vector3d>& true_joints,
                                    const std::vector<bool>& known, int frame) {
  RandomStream random(static_cast<std::uint64_t>(settings.seed),
                      fmt::format("stand-in joints {}", frame));
  std::vector<Vector3d> observed;
  for (std::size_t j = 0; j < true_joints.size(); ++j) {
    const bool is_outlier = random.Uniform() < settings.outlier_share;
    Vector3d noise;
    for (double& x : noise) {
      x = is_outlier ? random.Uniform(-settings.outlier_reach_m, settings.outlier_reach_m)
                     : random.Normal(0.0, settings.deviation_m);
    }
    if (!known[j]) {
      observed.push_back(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
      continue;
    }
    observed.push_back(true_joints[j] + settings.depth_bias_m * true_joints[j].normalized() +
                       noise);
  }
  return observed;
}

}  // namespace vitruvia
