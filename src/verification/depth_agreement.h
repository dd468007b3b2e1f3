// Agreement of a depth image with the true surface that it should show. Internal to this module.
#pragma once

#include <vector>

#include "geometry/image.h"

namespace vitruvia {

// Counts of pixels of one frame, or of several added up.
struct DepthAgreement {
  long rendered = 0;  // pixels that show the true surface
  long measured = 0;  // pixels with depth
  long both = 0;
  long agreeing = 0;           // of both: within kAgreeWithin_m
  std::vector<double> ratios;  // measured / rendered of some of both

  double AgreeingShare() const;  // of both; 0 if there are none
  double CoveredShare() const;   // both / rendered; 1 if nothing is rendered
  double Silhouette() const;     // intersection over union
  // Share of the rendered pixels that agree, by which causes are compared.
  double Score() const;
  // Median of ratios; 1 without any.
  double DepthRatio() const;
};

DepthAgreement Compare(const DepthImage& measured, const DepthImage& rendered);
void Add(const DepthAgreement& frame, DepthAgreement& sum);

// Counts of the pixels where the true surface's rendering and its mirrored or rotated version
// differ, by which of the two the depth matches.
struct MirrorVotes {
  long for_truth = 0, for_mirror = 0;
};
void Vote(const DepthImage& measured, const DepthImage& rendered, const DepthImage& mirrored,
          MirrorVotes& votes);

// Outline of the measured pixels against the rendered ones, along u and v: ratio of the spread; how
// far each edge is moved by that, pixels (of an even spread, whose standard deviation is its width
// / √12); and how far the centre is shifted, pixels.
struct OutlineDifference {
  double scale_u = 1.0, scale_v = 1.0, edges_u_px = 0.0, edges_v_px = 0.0;
  double shift_u_px = 0.0, shift_v_px = 0.0;
};
OutlineDifference CompareOutlines(const DepthImage& measured, const DepthImage& rendered);

}  // namespace vitruvia
