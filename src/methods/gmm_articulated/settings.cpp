#include "methods/gmm_articulated/settings.h"

namespace vitruvia::gmm_articulated {

void Settings::Describe(Fields& f) {
  f.Visit(common);
  f.Number("first_sigma_m", first_sigma_m,
           {.meaning = "standard deviation of the Gaussians in a frame's first iteration; later "
                       "iterations estimate it, down to half of a point's deviation",
            .unit = "m",
            .min = 0.001,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "0.03 to 0.05"});
  f.Number("outlier_share", outlier_share,
           {.meaning = "share of the points that no vertex explains",
            .min = 0,
            .max = 0.99,
            .origin = Origin::kGuessed,
            .source = "u"});
  f.Number("reach_sigmas", reach_sigmas,
           {.meaning = "standard deviations from its centre at which a Gaussian ends",
            .min = 1,
            .max = 10,
            .origin = Origin::kGuessed});
}

}  // namespace vitruvia::gmm_articulated
