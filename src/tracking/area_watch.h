// Tells from the areas that model and frame do not account for (body_areas.h) that a frame is lost.
#pragma once

#include <string>

#include "config/settings.h"
#include "tracking/body_areas.h"

namespace vitruvia {

struct AreaWatchSettings {
  double lost_above = 0.0;  // 0: areas are not watched
  double found_below = 0.03;
  int found_frames = 2;
  double reach_m = 0.3;
  double other_body_share = 0.5;
  int search_pause = 5;  // frames
  double margin = 0.02;

  void Describe(Fields& fields);
};

class AreaWatch {
 public:
  explicit AreaWatch(const AreaWatchSettings& settings) : settings_(settings) {}

  // Once for each frame with measurements. Lost is what disagrees by more than `lost_above`, until
  // it has disagreed by less than `found_below` for `found_frames` frames.
  void Assess(const BodyAreas& areas);
  // A search gave a pose with these areas, which was taken.
  void NoteFound(const BodyAreas& areas);

  bool is_lost() const { return is_lost_; }
  // Whether enough of the frame is out of the model's reach to be another body, the subject's own
  // perhaps, and no search has looked there lately: each that finds nothing doubles the pause.
  bool is_search_due() const { return is_search_due_; }
  std::string message() const;  // why a frame is lost, for a person

 private:
  AreaWatchSettings settings_;
  bool is_lost_ = false, is_search_due_ = false;
  int frames_agreed_ = 0;
  int frames_until_search_ = 0, pause_ = 0;
  double disagreement_ = 0.0;
};

}  // namespace vitruvia
