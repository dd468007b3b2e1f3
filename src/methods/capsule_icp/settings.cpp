#include "methods/capsule_icp/settings.h"

namespace vitruvia::capsule_icp {

void CapsuleSettings::Describe(Fields& f) {
  f.Integer("trunk_capsules", trunk_capsules,
            {.meaning = "capsules side by side that make up each of pelvis, abdomen and chest",
             .min = 1,
             .max = 4,
             .origin = Origin::kGuessed,
             .source = "a trunk is wider than deep"});
  f.Number("sample_spacing_m", sample_spacing_m,
           {.meaning = "spacing of the samples of the capsules' surface, which must not lie where "
                       "the frame shows empty space",
            .unit = "m",
            .min = 0.005,
            .max = 0.5,
            .origin = Origin::kGuessed});
}

void MatchSettings::Describe(Fields& f) {
  f.Number("first_cutoff_m", first_cutoff_m,
           {.meaning = "largest distance of an observed point from the model in a frame's first "
                       "iteration; it falls geometrically",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kGuessed});
  f.Number("last_cutoff_m", last_cutoff_m,
           {.meaning = "largest distance of an observed point from the model in a frame's last "
                       "iteration",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kGuessed});
  f.Number("facing_cosine", facing_cosine,
           {.meaning = "least cosine of the angle between the observed surface's normal and the "
                       "capsule's",
            .min = -1,
            .max = 1,
            .origin = Origin::kGuessed});
}

std::string MatchSettings::Problem() const {
  return last_cutoff_m > first_cutoff_m ? "last_cutoff_m is larger than first_cutoff_m" : "";
}

void SilhouetteSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the samples outside the observed silhouette, relative to that of "
                       "the points; 0: no silhouette term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kTuned,
            .source = "λ_s; captured/walk: from 0.05 on limbs stick to the trunk's edge"});
  if (!f.Applies(weight > 0.0)) return;
  f.Integer("reach_px", reach_px,
            {.meaning = "number of columns or rows from the silhouette beyond which a sample "
                        "outside it gets no row",
             .unit = "px",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed});
}

void FreeSpaceSettings::Describe(Fields& f) {
  f.Number("weight", weight,
           {.meaning = "weight of the samples in front of the observed surface, relative to that "
                       "of the points; 0: no free-space term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kTuned,
            .source = "λ_f; fig11: at 1 an arm before the trunk is pushed into it"});
  if (!f.Applies(weight > 0.0)) return;
  f.Number(
      "margin_m", margin_m,
      {.meaning = "depth by which a sample may lie in front of the observed surface at no cost",
       .unit = "m",
       .min = 0,
       .max = 1,
       .origin = Origin::kGuessed,
       .source = "δ = 3 σ"});
  f.Number("reach_m", reach_m,
           {.meaning = "depth beyond which a sample in front of the observed surface is assumed to "
                       "be another part of the body and gets no row",
            .unit = "m",
            .min = 0.001,
            .max = 10,
            .origin = Origin::kGuessed});
}

void Settings::Describe(Fields& f) {
  f.Visit(common);
  f.Section("capsules", capsules, {.meaning = "the capsules that represent the body"});
  f.Choice("data_term", data_term,
           {{"closest_point", DataTermKind::kClosestPoint},
            {"depth_difference", DataTermKind::kDepthDifference}},
           {.meaning = "correspondences of the data term: each observed point and its nearest "
                       "capsule, or observed and rendered depth at each pixel",
            .origin = Origin::kGuessed,
            .source = "Ganapathi 2012: closest_point; Wei 2012: depth_difference"});
  f.Section("match", match, {.meaning = "thresholds for matching points and pixels"});
  f.Section("silhouette", silhouette, {.meaning = "penalty on the model outside the silhouette"});
  f.Section("free_space", free_space,
            {.meaning = "penalty on the model in front of the observed surface"});
  f.Number("intersection_weight", intersection_weight,
           {.meaning = "weight of the overlap of two capsules whose bones are not neighbours, "
                       "relative to that of a point; 0: no intersection term",
            .min = 0,
            .max = 1e6,
            .origin = Origin::kGuessed,
            .source = "λ_i"});
}

}  // namespace vitruvia::capsule_icp
