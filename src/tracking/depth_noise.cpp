#include "tracking/depth_noise.h"

namespace vitruvia {

void DepthNoise::Describe(Fields& f) {
  constexpr const char* kSource = "a fact of the sensor; 0: its noise is left out of account";
  f.Number("axial_base_m", axial_base_m,
           {.meaning = "standard deviation of measured depth at noise.axial_near_m",
            .unit = "m",
            .min = 0,
            .max = 1,
            .source = kSource});
  f.Number("axial_growth_per_m", axial_growth_per_m,
           {.meaning = "growth of the deviation of measured depth with the square of the distance "
                       "from noise.axial_near_m",
            .unit = "1/m",
            .min = 0,
            .max = 1,
            .source = kSource});
  f.Number("axial_near_m", axial_near_m,
           {.meaning = "distance at which the sensor measures depth most accurately",
            .unit = "m",
            .min = 0,
            .max = 10,
            .source = kSource});
  f.Number("lateral_rad", lateral_rad,
           {.meaning = "standard deviation of the direction in which the sensor sees a point",
            .unit = "rad",
            .min = 0,
            .max = 0.1,
            .source = kSource});
}

}  // namespace vitruvia
