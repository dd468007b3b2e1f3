// Settings of loss detection and relocalisation. Paper A lists both as future work.
#pragma once

#include "config/settings.h"

namespace vitruvia {

struct RelocalizationSettings {
  int patience = 3;  // frames; 0: never relocalise
  int pause = 5;     // frames
  double agreement_threshold = 0.8;
  double doubt_threshold = 0.0;
  double least_usual = 0.0;
  double part_gap_m = 0.0;  // 0: the cloud is not divided into parts
  double margin = 0.1;
  int num_remembered = 8;
  double min_pose_distance_deg = 20.0;
  int num_refined = 3;

  void Describe(Fields& fields);
};

}  // namespace vitruvia
