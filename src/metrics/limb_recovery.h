// How soon a limb that was lost is found again once the camera sees it.
#pragma once

#include <vector>

namespace vitruvia {

// A limb in one frame.
struct LimbState {
  bool is_lost, is_visible;
};

struct LimbRecoveries {
  int losses = 0;     // losses in which the limb was visible, less those that are undecided
  int in_time = 0;    // of these: found within the allowed number of visible frames
  int undecided = 0;  // losses that the end of the run cut short before that number was over
};

// Losses of a limb: stretches of frames in which it is lost. Only frames in which the limb is
// visible are counted; a loss without such a frame is no case, since nothing showed the limb. A
// loss is found in time if it has at most `allowed_frames` of them.
LimbRecoveries CountRecoveries(const std::vector<LimbState>& frames, int allowed_frames);

}  // namespace vitruvia
