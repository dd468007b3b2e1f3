// The angles that motion files name.
#pragma once

#include <string>

#include "body/anatomical_pose.h"
#include "config/settings.h"

namespace vitruvia {

// The angles that a key frame or a named pose of a motion file mentions.
struct MentionedAngles {
  MentionedAngles();

  std::array<double, kMidlineAngleCount> midline_deg;  // NaN: not mentioned
  std::array<std::array<double, kSideAngleCount>, kSideCount> sides_deg;
  std::array<double, kSideAngleCount> both_sides_deg;

  void Describe(Fields& fields);
  std::string Problem() const;  // an angle given twice
  void ApplyTo(AnatomicalPose& pose) const;
};

}  // namespace vitruvia
