// Delay and loss of frames.
#pragma once

#include <cstdint>
#include <vector>

#include "config/settings.h"

namespace vitruvia {

struct DeliverySettings {
  double latency_s = 0.0;   // age of a frame when it is delivered
  double drop_share = 0.0;  // of frames at which a loss begins
  int drop_length = 1;      // frames lost at a time
  int gap_start = -1;       // first frame of one certain loss; -1: none
  int gap_length = 0;       // its length in frames

  void Describe(Fields& fields);
};

// For each of `frames` frames whether it is lost. The first frame always arrives.
std::vector<bool> LostFrames(const DeliverySettings& settings, int frames, std::uint64_t seed);

// The time that a frame delivered at time_s shows; never before 0.
double CaptureTime(const DeliverySettings& settings, double time_s);

}  // namespace vitruvia
