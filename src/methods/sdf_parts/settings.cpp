#include "methods/sdf_parts/settings.h"

namespace vitruvia::sdf_parts {

void FieldSettings::Describe(Fields& f) {
  f.Number("cell_m", cell_m,
           {.meaning = "spacing of the grids that hold the parts' signed distances",
            .unit = "m",
            .min = 0.001,
            .max = 0.1,
            .origin = Origin::kGuessed,
            .source = "DART: 0.005; twice that takes an eighth of the memory"});
  f.Number("margin_m", margin_m,
           {.meaning = "width of the space round a part that its grid covers",
            .unit = "m",
            .min = 0.01,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "DART: 0.1"});
  f.Number("least_weight", least_weight,
           {.meaning = "least weight with which a triangle follows a bone to belong to its part",
            .min = 0.01,
            .max = 0.5,
            .origin = Origin::kGuessed,
            .source = "below one half neighbouring parts overlap and a bent joint shows no gap"});
}

void ObservedSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the observed points' distances from the parts; 0: no such term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "DART: λ = 1"});
  f.Number("first_cutoff_m", first_cutoff_m,
           {.meaning = "largest distance of an observed point from the parts in a frame's first "
                       "iteration; it falls geometrically",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "DART: 0.03 throughout, for hands; a body moves farther in a frame"});
  f.Number("last_cutoff_m", last_cutoff_m,
           {.meaning = "largest distance of an observed point from the parts in a frame's last "
                       "iteration",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kGuessed});
  f.Number("huber_m", huber_m,
           {.meaning =
                "scale of the Huber kernel: distance up to which an observed point has full weight",
            .unit = "m",
            .min = 1e-4,
            .max = 10,
            .origin = Origin::kPaper,
            .source = "DART: 0.02"});
  f.Number("facing_cosine", facing_cosine,
           {.meaning = "least cosine of the angle between the observed surface's normal and the "
                       "part's",
            .min = -1,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "DART: -0.1"});
}

std::string ObservedSettings::Problem() const {
  return last_cutoff_m > first_cutoff_m ? "last_cutoff_m is larger than first_cutoff_m" : "";
}

void PredictedSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the predicted surface's distances from the observation, relative "
                       "to that of as many points; 0: no such term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kTuned,
            .source = "captured/walk; DART: λ = 1, with which limbs stick to the trunk"});
  if (!f.Applies(weight > 0.0)) return;
  f.Integer("stride_px", stride_px,
            {.meaning = "stride in columns and rows of the predicted depth",
             .unit = "px",
             .min = 1,
             .max = 16,
             .origin = Origin::kGuessed});
  f.Number("occupied_m", occupied_m,
           {.meaning = "distance from an observed point within which space counts as occupied",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kPaper,
            .source = "DART: a cell of its 64³ grid over the model's box, about 0.03 for a body"});
  f.Number("cutoff_m", cutoff_m,
           {.meaning = "distance from the observation beyond which a predicted point gets no row",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kTuned,
            .source = "captured/walk; DART: truncated, or not at all"});
}

void IntersectionSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the penetration depth of one part into another, relative to that "
                       "of as many points; 0: no such term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "DART: off unless switched on"});
  if (!f.Applies(weight > 0.0)) return;
  f.Number("samples_per_m2", samples_per_m2,
           {.meaning = "samples of a part's surface that are tested against the other parts",
            .unit = "1/m²",
            .min = 1,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "DART: 1e5, on a graphics card"});
}

void Settings::Describe(Fields& f) {
  f.Visit(common);
  f.Section("field", field, {.meaning = "the parts and their signed distance fields"});
  f.Section("observed", observed, {.meaning = "distances from the observation to the model"});
  f.Section("predicted", predicted,
            {.meaning = "distances from the predicted model to the observation"});
  f.Section("intersection", intersection, {.meaning = "penalty on intersecting parts"});
}

std::string Settings::Problem() const {
  return observed.first_cutoff_m > field.margin_m
             ? "observed.first_cutoff_m is larger than field.margin_m, beyond which no distance is "
               "known"
             : "";
}

}  // namespace vitruvia::sdf_parts
