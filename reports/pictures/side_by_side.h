// Runs of one sequence below each other, frame by frame, for comparing variants and consecutive
// frames.
#pragma once

#include "reports/pictures/pictures.h"

namespace vitruvia {

// One entry per sequence that two or more finished runs have tracked; none unless the experiment
// asks for them. A strip's pictures are the picture frames: first depth, then the truth, then each
// run's reconstruction, all seen by the camera and held at the place of the truth. Skin that looks
// to the front in the rest pose has one colour, skin that looks to the back another. What was drawn
// before is taken as it is.
std::vector<RunPictures> MakeSideBySide(const ReportedExperiment& experiment,
                                        const DrawnBefore& before, const PictureUse& use = {});

}  // namespace vitruvia
