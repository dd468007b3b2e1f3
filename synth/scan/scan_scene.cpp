#include "synth/scan/scan_scene.h"

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kNearestRadiusM = 0.6;  // clear of the body, but for its outstretched arms

}  // namespace

void CameraPathSettings::Describe(Fields& f) {
  f.Number(
      "start_deg", start_deg,
      {.meaning = "azimuth at which the camera starts: 0 in front of the subject, 90 on its left",
       .unit = "deg",
       .min = -360.0,
       .max = 360.0});
  f.Number("radius_m", radius_m,
           {.meaning = "distance from the vertical axis through the subject's place",
            .unit = "m",
            .min = kNearestRadiusM,
            .max = 10.0});
  f.Number(
      "turns", turns,
      {.meaning = "turns round the subject, towards its left first", .min = -20.0, .max = 20.0});
  f.Numbers("heights_m", heights_m,
            {.meaning = "heights between which the camera moves up and down, starting at the first",
             .unit = "m",
             .min = 0.0,
             .max = 5.0});
  f.Numbers("look_at_heights_m", look_at_heights_m,
            {.meaning = "the camera looks at the subject's vertical axis between these heights",
             .unit = "m",
             .min = -1.0,
             .max = 5.0});
  f.Number(
      "height_cycles", height_cycles,
      {.meaning = "number of times that the camera moves up and down", .min = 0.0, .max = 100.0});
  f.Number("jitter_m", jitter_m,
           {.meaning = "unsteadiness of the hand: standard deviation of the camera's place",
            .unit = "m",
            .min = 0.0,
            .max = 0.2});
  f.Number("jitter_deg", jitter_deg,
           {.meaning = "unsteadiness of the hand: standard deviation of its direction, per axis",
            .unit = "deg",
            .min = 0.0,
            .max = 10.0});
}

std::string CameraPathSettings::Problem() const {
  for (std::size_t i = 0; i < 2; ++i) {
    const double steep = heights_m[i] - look_at_heights_m[i];
    if (steep > 5.0 * radius_m || steep < -5.0 * radius_m) {
      return fmt::format(
          "the camera at a height of {:g} m and {:g} m from the axis looks at a height of {:g} m: "
          "too steep to have an upright",
          heights_m[i], radius_m, look_at_heights_m[i]);
    }
  }
  return "";
}

void StanceSettings::Describe(Fields& f) {
  f.Number("arms_lowered_deg", arms_lowered_deg,
           {.meaning = "angle by which the arms hang below those of the T-pose",
            .unit = "deg",
            .min = -30.0,
            .max = 60.0});
  f.Number("sway_deg", sway_deg,
           {.meaning = "amplitude of the body's lean about the ankles, forwards and sideways",
            .unit = "deg",
            .min = 0.0,
            .max = 10.0});
  f.Number("arm_sway_deg", arm_sway_deg,
           {.meaning = "amplitude with which the arms go up and down",
            .unit = "deg",
            .min = 0.0,
            .max = 30.0});
  f.Number("sway_period_s", sway_period_s,
           {.meaning = "time of one sway forwards and back",
            .unit = "s",
            .min = 0.1,
            .max = 100.0,
            .origin = Origin::kGuessed,
            .source = "quiet standing sways below 0.5 Hz"});
}

void BystanderSettings::Describe(Fields& f) {
  f.Numbers(
      "place_m", place_m,
      {.meaning =
           "position of another body of the same shape: x to the subject's left, z to its front",
       .unit = "m",
       .min = -10.0,
       .max = 10.0});
}

void ScanSceneSettings::Describe(Fields& f) {
  f.Section("body", body, {.meaning = "the person"});
  f.Section("truth", truth, {.meaning = "the true surface, which is rendered"});
  f.Section("stance", stance, {.meaning = "how the person stands"});
  f.List("bystanders", bystanders, {.meaning = "others who stand in view"});
  f.Section("camera", camera, {.meaning = "intrinsics"});
  f.Section("path", path, {.meaning = "how the camera moves"});
  f.Section("sensor", sensor, {.meaning = "sensor model of the camera"});
  f.Integer("frames", frames,
            {.meaning = "length of the scan",
             .min = 1,
             .max = 100000,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 7: a scan takes about 30 s"});
  f.Number("fps", fps,
           {.meaning = "frames per second",
            .min = 0.1,
            .max = 1000.0,
            .origin = Origin::kPaper,
            .source = "paper A, sec. 6.2: 30 frames/s"});
  f.Integer("seed", seed, {.meaning = "seed of the hand's unsteadiness and the noise", .min = 0});
}

std::string ScanSceneSettings::Problem() const {
  const DeliverySettings& d = sensor.delivery;
  if (d.latency_s != 0.0 || d.drop_share != 0.0 || d.gap_start >= 0) {
    return "sensor.delivery: a scan is fused from all its frames, however late; expected none lost "
           "and no latency";
  }
  return "";
}

}  // namespace vitruvia
