// Settings of the segmentation of a person in depth images.
#pragma once

#include <string>

#include "config/settings.h"

namespace vitruvia {

enum class BackgroundSource {
  kNone,         // only range and floor separate the person from the room
  kRecording,    // the farthest depth that a pixel shows during the recording
  kEmptyFrames,  // the depth that a pixel shows in frames without a person
};

struct BackgroundSettings {
  BackgroundSource source = BackgroundSource::kRecording;
  double far_share = 0.9;
  double seen_share = 0.5;
  double margin_m = 0.01;
  int samples = 60;

  void Describe(Fields& fields);
};

struct FloorSettings {
  bool remove = true;
  double tilt_deg = 45.0;
  double within_m = 0.02;
  double least_share = 0.03;
  double below_share = 0.05;
  int trials = 20000;
  int points = 5000;
  double margin_m = 0.01;
  double certain_m = 0.10;
  double reach_m = 0.25;

  void Describe(Fields& fields);
};

// Connected components in three dimensions (pieces.h).
struct PieceSettings {
  double step_m = 0.06;
  double gap_m = 0.25;
  double least_area_m2 = 0.002;

  void Describe(Fields& fields);
};

// Size limits of a piece that may be a person.
struct PersonSizeSettings {
  double least_height_m = 0.5, most_height_m = 2.4;
  double most_width_m = 2.2;
  double least_area_m2 = 0.1;

  void Describe(Fields& fields);
};

// Separation of people who form one piece.
struct TouchingSettings {
  double head_drop_m = 0.15;
  double least_head_m2 = 0.015;
  double apart_m = 0.25;
  double least_area_m2 = 0.2;
  double least_height_share = 0.6;

  void Describe(Fields& fields);
};

// Outlines of people (outline.h).
struct OutlineSettings {
  int reach_px = 3;
  double spread_px = 1.2;
  double depth_share = 0.4;
  double least_sigmas = 1.0;
  double doubtful_weight = 0.5;

  void Describe(Fields& fields);
};

struct FollowingSettings {
  double same_place_m = 0.3;
  double claim_share = 0.15;
  double attach_m = 0.1;
  double speed_m_s = 4.0;
  double forget_s = 1.0;
  double area_factor = 1.5;
  int area_window = 15;

  void Describe(Fields& fields);
};

enum class PersonChoice {
  kLargest,  // area, summed over the frames
  kNearest,  // mean depth
  kPixel,    // the person at a given pixel of a frame
};

struct PersonSettings {
  PersonChoice choose = PersonChoice::kLargest;
  int frame = 0, u = 0, v = 0;
  PersonSizeSettings size;
  TouchingSettings touching;

  void Describe(Fields& fields);
};

struct CutoutSettings {
  double near_m = 0.4, far_m = 6.0;
  double noise_sigmas = 3.0;
  double noise_at_1m_m = 0.0014;
  BackgroundSettings background;
  FloorSettings floor;
  PieceSettings pieces;
  PersonSettings person;
  FollowingSettings following;
  OutlineSettings outline;
  int seed = 1;

  void Describe(Fields& fields);
  std::string Problem() const;
};

}  // namespace vitruvia
