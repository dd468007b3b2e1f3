#include "synth/sensor/sensor.h"

#include <algorithm>

namespace vitruvia {

void SensorSettings::Describe(Fields& f) {
  f.Choice("model", model, {{"ideal", SensorModel::kIdeal}, {"gaussian", SensorModel::kGaussian}},
           {.meaning = "ideal: true depth, only rounded to depth_unit_m; "
                       "gaussian: independent noise and dropout at each pixel"});
  if (f.Applies(model == SensorModel::kGaussian)) {
    f.Number("sigma_m", sigma_m,
             {.meaning = "gaussian: standard deviation of depth",
              .unit = "m",
              .min = 0.0,
              .max = 1.0,
              .origin = Origin::kGuessed,
              .source = "time of flight at 1 to 3 m: 1 to 3 mm"});
    f.Number(
        "dropout", dropout,
        {.meaning = "gaussian: share of pixels without a measurement", .min = 0.0, .max = 1.0});
  }
  f.Number("depth_unit_m", depth_unit_m,
           {.meaning = "step of stored depth",
            .unit = "m",
            .min = 1e-6,
            .max = 0.1,
            .origin = Origin::kGuessed,
            .source = "depth cameras commonly store millimetres"});
}

DepthImage Measure(const DepthImage& true_depth, const SensorSettings& settings,
                   RandomStream& random) {
  if (settings.model == SensorModel::kIdeal) return true_depth;
  DepthImage measured = true_depth;
  for (float& depth : measured.pixels()) {
    if (depth <= 0.0f) continue;
    // Both numbers are drawn at every pixel: a change of dropout must not change the noise.
    const bool dropped = random.Uniform() < settings.dropout;
    const double noisy = random.Normal(depth, settings.sigma_m);
    depth = dropped ? 0.0f : static_cast<float>(std::max(noisy, 0.0));
  }
  return measured;
}

}  // namespace vitruvia
