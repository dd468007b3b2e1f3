#include "tracking/area_watch.h"

#include <fmt/format.h>

namespace vitruvia {

void AreaWatchSettings::Describe(Fields& f) {
  f.Number("lost_above", lost_above,
           {.meaning = "a frame is reported as lost when a larger share of the observed area is "
                       "unexplained by the model or contradicts it; 0: no detection by areas",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "0.065 on captured/tuning"});
  if (!f.Applies(lost_above > 0.0)) return;
  f.Number("found_below", found_below,
           {.meaning = "a lost subject counts as found again when a smaller share of the observed "
                       "area is unexplained by the model or contradicts it",
            .min = 0,
            .max = 1,
            .origin = Origin::kTuned,
            .source = "captured/tuning"});
  f.Integer("found_frames", found_frames,
            {.meaning = "number of frames in a row that must agree before a lost subject counts as "
                        "found again",
             .unit = "frames",
             .min = 1,
             .max = 1e6,
             .origin = Origin::kTuned,
             .source = "captured/tuning"});
  f.Number("reach_m", reach_m,
           {.meaning = "points farther than this from every bone's axis are out of reach: they do "
                       "not belong to a lost limb",
            .unit = "m",
            .min = 0,
            .max = 100,
            .origin = Origin::kGuessed,
            .source = "0.3 and 0.5 tell the same frames of captured/tuning"});
  f.Number(
      "other_body_share", other_body_share,
      {.meaning = "a lost subject is searched among the points out of the model's reach when "
                  "their area exceeds this multiple of the visible area of the model",
       .min = 0,
       .max = 1e6,
       .origin = Origin::kGuessed,
       .source = "a person seen from the side shows half the area of one seen from the front"});
  f.Integer("search_pause", search_pause,
            {.meaning = "least number of frames between two searches among the points out of "
                        "reach; doubled by each search that finds nothing",
             .unit = "frames",
             .min = 1,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = "as recovery.pause"});
  f.Number("margin", margin,
           {.meaning = "a pose found among the points out of reach replaces the current one if its "
                       "overlap with the frame is higher by this",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "above what noise changes"});
}

void AreaWatch::Assess(const BodyAreas& areas) {
  disagreement_ = areas.disagreement();
  if (disagreement_ > settings_.lost_above) is_lost_ = true;
  frames_agreed_ = disagreement_ < settings_.found_below ? frames_agreed_ + 1 : 0;
  if (frames_agreed_ >= settings_.found_frames) is_lost_ = false;

  pause_.NextFrame();
  const bool is_other_body =
      areas.stray_m2 > settings_.other_body_share * areas.total().visible_m2();
  if (!is_other_body) pause_.Reset();
  is_search_due_ = is_lost_ && is_other_body && pause_.is_over();
  if (is_search_due_) pause_.Begin();
}

std::string AreaWatch::message() const {
  return fmt::format("model and frame do not account for {:.0f} % of the observed area",
                     100.0 * disagreement_);
}

void AreaWatch::NoteFound(const BodyAreas& areas) {
  disagreement_ = areas.disagreement();
  is_lost_ = disagreement_ > settings_.lost_above;
  frames_agreed_ = 0;
  pause_.Reset();
  pause_.Begin();
}

}  // namespace vitruvia
