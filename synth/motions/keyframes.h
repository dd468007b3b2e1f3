// Key-framed motions (keyframes_file.h) of a body.
#pragma once

#include <memory>

#include "synth/motions/keyframes_file.h"
#include "synth/motions/motion.h"

namespace vitruvia {

// All samples are grounded. Horizontally, the pelvis follows the key frames' path plus a correction
// that keeps planted limbs fixed: with limb positions p_i(t) relative to the pelvis and weights
// w_i(t), −∫ Σ w_i dp_i. Limbs that are planted at both of two neighbouring key frames share the
// weight equally between them; the weights change smoothly within a tenth of a second.
std::unique_ptr<Motion> MakeKeyframedMotion(const KeyframeSequence& sequence,
                                            const Skeleton& skeleton);

}  // namespace vitruvia
