// Clothes on a true surface, which the template does not have.
//
// Every vertex of the rest surface is moved along its normal, by the sum of
//   volume     a smooth field, the same in all frames: differences of the template's proportions
//   thickness  of the cloth
//   folds      waves across each bent joint, deeper on the side that the bend compresses; their
//              depth changes with the joint's angle
//   wrinkles   waves that drift slowly over all the cloth with time, independent of the pose
//   drape      sleeves and trouser legs hang below limbs that are not upright
// all seeded, then skinned with the true bones. Head, hands and feet are bare. This is not a
// simulation of cloth: there is no inertia, no sliding on the skin and no contact.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "config/settings.h"

namespace vitruvia {

struct ClothSettings {
  double volume_m = 0.0;
  double thickness_m = 0.0;
  double fold_depth_m = 0.0;
  double fold_wavelength_m = 0.05;
  double wrinkle_depth_m = 0.0;
  double drape_m = 0.0;

  void Describe(Fields& fields);
  bool IsBare() const;  // nothing is moved
};

class Garment {
 public:
  Garment(const BodyModel& body, const ClothSettings& settings, std::uint64_t seed);

  // Displaces the body's rest vertices by the cloth in a pose at a time. Deterministic.
  void Dress(const JointPose& pose, double time_s, std::vector<Vector3f>& rest_vertices) const;

 private:
  struct Wave {
    Vector3d direction;  // radians per metre
    double phase, rate;  // radians, radians per second
  };
  // A vertex near a joint that wears cloth.
  struct FoldSite {
    int vertex, joint;
    double along_m;     // signed distance from the joint along the limb
    Vector3d outwards;  // unit, from the limb's axis to the vertex
    double around_rad;  // the angle round the limb's axis
    double nearness;    // 1 at the joint … 0 far from it
  };
  // How a pose bends a joint.
  struct Bend {
    double amount = 0.0;  // 1: fully
    bool leans = false;   // the limb's axis is turned, not only about itself
    Vector3d lean;        // unit, where it is turned to
    double twist = 0.0;   // radians about the limb's axis
  };
  static constexpr std::size_t kWaves = 6;  // in each field of waves

  double Volume(const Vector3d& rest_vertex) const;
  Bend BendOf(int joint, const JointPose& pose) const;
  void AddFolds(const JointPose& pose, std::vector<double>& offsets) const;
  void AddDrape(const JointPose& pose, std::vector<double>& offsets) const;

  const BodyModel& body_;
  ClothSettings settings_;
  std::vector<Vector3f> normals_;
  std::vector<double> covered_;                             // 0 bare … 1 clothed, per vertex
  std::vector<double> volumes_m_;                           // per vertex
  std::vector<std::array<double, kWaves>> wrinkle_shapes_;  // each wave's at rest, per vertex
  std::vector<Wave> volume_waves_, wrinkle_waves_;
  std::vector<FoldSite> fold_sites_;
  std::vector<double> fold_phases_;  // per joint
};

}  // namespace vitruvia
