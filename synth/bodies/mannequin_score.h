// The score of girths that gives the mannequin a volume.
#pragma once

#include <functional>

namespace vitruvia::mannequin {

inline constexpr double kLeastScore = -7.0, kGreatestScore = 9.0;  // more than weights need
inline constexpr int kScoreSteps = 24;  // of bisection: the error is then below float precision

// The middle of the last step of bisection, for a volume that increases with the score. Most steps
// are decided by scores that were tried before, close to the one looked for and on both sides of
// it, where secants lead: the result is the same after half as many trials.
double ScoreOfVolume(const std::function<double(double)>& volume_at, double volume_m3);

}  // namespace vitruvia::mannequin
