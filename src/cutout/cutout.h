// Segmentation of a person in a depth recording.
//
//   LearnRoom (room.h)            from sampled frames: background, noise, floor
//   PiecesOf                      frame by frame, in any order and on any thread
//   PeopleFollower (following.h)  frame by frame, in order
//   SmoothOutlines (outline.h)    frame by frame, in any order and on any thread
//   ChoosePerson                  selects the person after the last frame
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cutout/following.h"
#include "cutout/outline.h"

namespace vitruvia {

// The pieces of one frame's foreground.
Pieces PiecesOf(const DepthImage& depth, const Room& room, const CutoutSettings& settings);

// The chosen person. A person who leaves and comes back has several numbers: people who are never
// seen in the same frame as one already chosen are assumed to be the same person.
struct ChosenPerson {
  std::vector<int> numbers;  // from 1, the first is the one that the settings choose
};

// Nothing if nobody was seen. `at_pixel`: number of the person at the pixel of the settings, 0 for
// nobody; used only with PersonChoice::kPixel.
std::optional<ChosenPerson> ChoosePerson(const std::vector<FollowedPerson>& people,
                                         const PersonSettings& settings, int at_pixel);

// kSubjectMask where the chosen person is, kForeignDepthMask where another depth is measured inside
// of the person's outline (mask_png.h).
MaskImage MaskOf(const OutlinedPeople& people, const ChosenPerson& chosen);

struct UnsureFrame {
  int frame = 0;
  std::string why;
};

// Summary of the cutout after the last frame.
struct CutoutReport {
  int frames = 0, frames_without_person = 0;
  int area_jumps = 0;
  double pixel_share = 0.0;         // of the image; mean over the frames that contain the person
  double area_m2 = 0.0;             // median
  std::vector<UnsureFrame> unsure;  // in ascending order, each once

  void AddUnsure(int frame, const std::string& why);
};

// `pixel_shares`: of each frame's mask.
CutoutReport ReportCutout(const std::vector<FollowedPerson>& people, const ChosenPerson& chosen,
                          const std::vector<double>& pixel_shares,
                          const FollowingSettings& settings);

}  // namespace vitruvia
