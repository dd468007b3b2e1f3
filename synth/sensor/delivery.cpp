#include "synth/sensor/delivery.h"

#include <algorithm>

#include "core/random.h"

namespace vitruvia {

void DeliverySettings::Describe(Fields& f) {
  f.Number("latency_s", latency_s,
           {.meaning = "delay of the images: a frame shows the body as it was this long before the "
                       "time of the frame's truth",
            .unit = "s",
            .min = 0,
            .max = 10});
  f.Number("drop_share", drop_share,
           {.meaning = "chance of each frame but the first that a loss of drop_length frames "
                       "begins; a lost frame is stored empty",
            .min = 0,
            .max = 1});
  f.Integer("drop_length", drop_length,
            {.meaning = "number of consecutive frames in each random loss",
             .unit = "frames",
             .min = 1,
             .max = 1000});
  f.Integer("gap_start", gap_start,
            {.meaning = "first frame of a planned loss; -1 for none",
             .unit = "frames",
             .min = -1,
             .max = 1e6});
  f.Integer("gap_length", gap_length,
            {.meaning = "number of frames in the planned loss that starts at gap_start",
             .unit = "frames",
             .min = 0,
             .max = 1e6});
}

std::vector<bool> LostFrames(const DeliverySettings& settings, int frames, std::uint64_t seed) {
  std::vector<bool> lost(frames, false);
  const auto lose = [&](int first, int count) {
    for (int i = std::max(first, 1); i < std::min(first + count, frames); ++i) lost[i] = true;
  };
  RandomStream random(seed, "sensor/delivery");
  for (int i = 1; i < frames; ++i) {
    if (random.Uniform() < settings.drop_share) lose(i, settings.drop_length);
  }
  if (settings.gap_start >= 0) lose(settings.gap_start, settings.gap_length);
  return lost;
}

double CaptureTime(const DeliverySettings& settings, double time_s) {
  return std::max(time_s - settings.latency_s, 0.0);
}

}  // namespace vitruvia
