// Colour maps and the palette of the report.
#pragma once

#include <vector>

#include "reports/drawing/color_image.h"

namespace vitruvia {

// Both maps are perceptually uniform, also in grey and for colour-blind readers.

// Depth: yellow is near, dark violet is far. `share` is 0 at the nearest depth shown and 1 at the
// farthest; values beyond are clamped.
Color DepthColor(double share);

// Error: pale is none, dark violet is the scale's end and beyond. `share` is error / scale.
Color ErrorColor(double share);

// Neighbouring bones have different hues: the golden angle round the circle of colours.
Color BoneColor(int bone);

// Upper end of an error scale: a round number that is at least `smallest` and not below 98 % of
// `errors`.
double ErrorScaleEnd(std::vector<double> errors, double smallest);

// Of runs in plots: distinct to the colour-blind (Okabe and Ito's set without its yellow).
inline constexpr std::array<Color, 7> kRunColors = {{{0x00, 0x72, 0xb2},
                                                     {0xd5, 0x5e, 0x00},
                                                     {0x00, 0x9e, 0x73},
                                                     {0xcc, 0x79, 0xa7},
                                                     {0xe6, 0x9f, 0x00},
                                                     {0x56, 0xb4, 0xe9},
                                                     {0x33, 0x33, 0x33}}};
inline constexpr Color kEstimateColor{0x5b, 0xa3, 0xd9};
inline constexpr Color kTruthColor{0xe8, 0x9b, 0x3c};
// Colours of the skin that faces the front and the back in the rest pose, which make twisted limbs
// visible.
inline constexpr Color kFrontColor{0x8f, 0xbf, 0xe0};
inline constexpr Color kBackColor{0xd0, 0x6a, 0x2c};
inline constexpr Color kFailureColor{0xb0, 0x00, 0x20};

}  // namespace vitruvia
