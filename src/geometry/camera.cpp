#include "geometry/camera.h"

namespace vitruvia {

void PinholeCamera::Describe(Fields& f) {
  f.Integer("width", width,
            {.meaning = "image width",
             .unit = "px",
             .min = 1,
             .max = 8192,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2: 320×240"});
  f.Integer("height", height,
            {.meaning = "image height",
             .unit = "px",
             .min = 1,
             .max = 8192,
             .origin = Origin::kPaper,
             .source = "paper A, sec. 6.2: 320×240"});
  f.Number("fx", fx,
           {.meaning = "focal length along x",
            .unit = "px",
            .min = 1,
            .max = 1e5,
            .origin = Origin::kGuessed,
            .source = "Kinect v1 at 320 columns: about 285"});
  f.Number("fy", fy,
           {.meaning = "focal length along y",
            .unit = "px",
            .min = 1,
            .max = 1e5,
            .origin = Origin::kGuessed,
            .source = "Kinect v1 at 320 columns: about 285"});
  f.Number("cx", cx,
           {.meaning = "principal point, column (pixel centres at whole numbers)",
            .unit = "px",
            .min = -1e5,
            .max = 1e5,
            .origin = Origin::kGuessed,
            .source = "image centre"});
  f.Number("cy", cy,
           {.meaning = "principal point, row (pixel centres at whole numbers)",
            .unit = "px",
            .min = -1e5,
            .max = 1e5,
            .origin = Origin::kGuessed,
            .source = "image centre"});
}

}  // namespace vitruvia
