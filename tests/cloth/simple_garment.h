// Cloth computed anew for each vertex and frame, which the garment's must equal.
#pragma once

#include "synth/cloth/garment.h"

namespace vitruvia {

class SimpleGarment {
 public:
  SimpleGarment(const BodyModel& body, const ClothSettings& settings, std::uint64_t seed);

  void Dress(const JointPose& pose, double time_s, std::vector<Vector3f>& rest_vertices) const;

 private:
  struct Wave {
    Vector3d direction;
    double phase, rate;
  };
  struct FoldSite {
    int vertex, joint;
    double along_m;
    Vector3d outwards;
    double nearness;
  };

  double Volume(int vertex) const;
  void AddFolds(const JointPose& pose, std::vector<double>& offsets) const;
  void AddDrape(const JointPose& pose, std::vector<double>& offsets) const;

  const BodyModel& body_;
  ClothSettings settings_;
  std::vector<Vector3f> normals_;
  std::vector<double> covered_;
  std::vector<Wave> volume_waves_, wrinkle_waves_;
  std::vector<FoldSite> fold_sites_;
  std::vector<double> fold_phases_;
};

}  // namespace vitruvia
