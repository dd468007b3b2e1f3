#include "synth/sensor/sensor.h"

#include <algorithm>

#include "synth/sensor/shared_noise.h"

namespace vitruvia {
namespace {

DepthImage WithGaussianNoise(const DepthImage& true_depth, double sigma_m, int shared_px,
                             RandomStream& random) {
  Image<double> draws(true_depth.width(), true_depth.height());
  for (std::size_t i = 0; i < draws.pixels().size(); ++i) {
    if (true_depth.pixels()[i] > 0.0f || shared_px > 1) draws.pixels()[i] = random.Normal();
  }
  const Image<double> along = SharedNoise(draws, shared_px);
  DepthImage measured = true_depth;
  for (std::size_t i = 0; i < draws.pixels().size(); ++i) {
    float& depth = measured.pixels()[i];
    if (depth <= 0.0f) continue;
    depth = static_cast<float>(std::max(depth + sigma_m * along.pixels()[i], 0.0));
  }
  return measured;
}

// From a stream of its own: a change of dropout must not change the noise.
void DropPixels(double share, RandomStream random, DepthImage& measured) {
  for (float& depth : measured.pixels()) {
    if (random.Uniform() < share) depth = 0.0f;
  }
}

}  // namespace

void SensorSettings::Describe(Fields& f) {
  f.Choice("model", model,
           {{"ideal", SensorModel::kIdeal},
            {"gaussian", SensorModel::kGaussian},
            {"kinect_v1", SensorModel::kKinectV1},
            {"kinect_one", SensorModel::kKinectOne}},
           {.meaning = "ideal: true depth, only rounded to depth_unit_m; gaussian: independent "
                       "noise at each pixel; kinect_v1: structured light; kinect_one: time of "
                       "flight"});
  if (f.Applies(model == SensorModel::kGaussian)) {
    f.Number("sigma_m", sigma_m,
             {.meaning = "standard deviation of depth (gaussian only)",
              .unit = "m",
              .min = 0.0,
              .max = 1.0,
              .origin = Origin::kGuessed,
              .source = "time of flight at 1 to 3 m: 1 to 3 mm"});
  }
  if (f.Applies(model == SensorModel::kKinectV1)) {
    f.Section("kinect_v1", kinect_v1,
              {.meaning = "noise of a structured-light sensor (kinect_v1 only)"});
  }
  if (f.Applies(model == SensorModel::kKinectOne)) {
    f.Section("kinect_one", kinect_one,
              {.meaning = "noise of a time-of-flight sensor (kinect_one only)"});
  }
  if (f.Applies(model != SensorModel::kIdeal)) {
    f.Number("dropout", dropout,
             {.meaning = "share of pixels, drawn at random, that have no measurement",
              .min = 0.0,
              .max = 1.0});
    f.Integer(
        "shared_px", shared_px,
        {.meaning = "width of the square window of pixels over which depth noise is correlated, at "
                    "the same standard deviation per pixel; 1: independent pixels",
         .unit = "px",
         .min = 1,
         .max = 99,
         .origin = Origin::kGuessed,
         .source = "the published models give no correlation; a Kinect v1 correlates a "
                   "pattern over windows of 9 pixels of its own image"});
  }
  f.Number("depth_unit_m", depth_unit_m,
           {.meaning = "unit of stored depth",
            .unit = "m",
            .min = 1e-6,
            .max = 0.1,
            .origin = Origin::kGuessed,
            .source = "depth cameras commonly store millimetres"});
  f.Section("delivery", delivery, {.meaning = "which frames arrive, and when"});
}

DepthImage Measure(const DepthImage& true_depth, const PinholeCamera& camera,
                   const SensorSettings& settings, RandomStream& random) {
  if (settings.model == SensorModel::kIdeal) return true_depth;
  const RandomStream dropout_stream(random.NextBits(), "dropout");
  DepthImage measured;
  switch (settings.model) {
    case SensorModel::kIdeal:
      break;
    case SensorModel::kGaussian:
      measured = WithGaussianNoise(true_depth, settings.sigma_m, settings.shared_px, random);
      break;
    case SensorModel::kKinectV1:
      measured = MeasureByStructuredLight(true_depth, camera, settings.kinect_v1,
                                          settings.shared_px, random);
      break;
    case SensorModel::kKinectOne:
      measured = MeasureByTimeOfFlight(true_depth, camera, settings.kinect_one, settings.shared_px,
                                       random);
      break;
  }
  DropPixels(settings.dropout, dropout_stream, measured);
  return measured;
}

}  // namespace vitruvia
