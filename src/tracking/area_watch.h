// Detects lost frames from the areas in which model and frame disagree (body_areas.h).
#pragma once

#include <string>

#include "config/settings.h"
#include "tracking/body_areas.h"
#include "tracking/search_pause.h"

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
  explicit AreaWatch(const AreaWatchSettings& settings)
      : settings_(settings), pause_(settings.search_pause) {}

  // To be called once for each frame with measurements. The subject is lost when the disagreement
  // exceeds `lost_above`, and until it has been below `found_below` for `found_frames` frames.
  void Assess(const BodyAreas& areas);
  // To be called after the pose of a search, with these areas, was adopted.
  void NoteFound(const BodyAreas& areas);

  bool is_lost() const { return is_lost_; }
  // Whether the measurements out of the model's reach are enough for another body, possibly the
  // subject's, and the pause since the last search has passed. Each search without success doubles
  // the pause.
  bool is_search_due() const { return is_search_due_; }
  std::string message() const;  // why a frame is lost, for the user

 private:
  AreaWatchSettings settings_;
  bool is_lost_ = false, is_search_due_ = false;
  int frames_agreed_ = 0;
  SearchPause pause_;
  double disagreement_ = 0.0;
};

}  // namespace vitruvia
