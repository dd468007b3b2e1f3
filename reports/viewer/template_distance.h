// How far an estimated surface is from its template as bones alone would carry it: for methods that
// warp the template, the length of the warps.
#pragma once

#include <vector>

#include "body/body_model.h"

namespace vitruvia {

class TemplateDistance {
 public:
  // Weights are those of the subject's vertex that is nearest in the rest pose.
  TemplateDistance(const std::vector<Vector3f>& rest_vertices, const BodyModel& subject);

  // Metres, for each vertex. Bones are put where the vertices that follow one nearly alone are.
  std::vector<float> Of(const std::vector<Vector3f>& posed) const;

 private:
  std::vector<Vector3f> rest_;
  SkinWeights weights_;
  std::vector<std::vector<int>> rigid_vertices_;  // by bone
};

}  // namespace vitruvia
