#include "tracking/relocalization_settings.h"

namespace vitruvia {

void RelocalizationSettings::Describe(Fields& f) {
  constexpr const char* kSource = "paper A lists recovery as future work";
  f.Integer("patience", patience,
            {.meaning = "number of consecutive frames with low agreement of model and frame after "
                        "which other poses are searched; 0 switches relocalisation off",
             .unit = "frames",
             .min = 0,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Number("agreement_threshold", agreement_threshold,
           {.meaning = "agreement of model and frame counts as low below this share of its usual "
                       "level",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Number("doubt_threshold", doubt_threshold,
           {.meaning = "a frame whose agreement is below this share of its usual level is reported "
                       "as lost, though other poses are not searched yet",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Number("least_usual", least_usual,
           {.meaning = "lower bound of the usual agreement of model and frame, so that a poor "
                       "agreement in the first frame does not become the usual one",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  if (!f.Applies(patience > 0)) return;
  f.Number("part_gap_m", part_gap_m,
           {.meaning =
                "the cloud is split into parts where depth jumps by more than this, and a search "
                "also tries poses at each part's centre; 0: only at the centre of the whole cloud",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("pause", pause,
            {.meaning = "number of frames between two searches for a lost subject",
             .unit = "frames",
             .min = 1,
             .max = 1e6,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Number("margin", margin,
           {.meaning = "a pose found by a search replaces the current one only if its score "
                       "(explained share of the cloud times confirmed share of the model) is "
                       "higher by at least this much",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("num_remembered", num_remembered,
            {.meaning = "number of well-tracked poses kept as hypotheses for a search",
             .min = 1,
             .max = 100,
             .origin = Origin::kGuessed,
             .source = kSource});
  f.Number("min_pose_distance_deg", min_pose_distance_deg,
           {.meaning = "a pose is remembered only if its joint angles differ from those of every "
                       "remembered pose by at least this much on average",
            .unit = "deg",
            .min = 0,
            .max = 180,
            .origin = Origin::kGuessed,
            .source = kSource});
  f.Integer("num_refined", num_refined,
            {.meaning = "number of best-scoring hypotheses that a search refines by iterations",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = kSource});
}

}  // namespace vitruvia
