// A moving body for tests of trackers: truth and depth of a mannequin that bends its arms.
#pragma once

#include "body/body_model.h"
#include "geometry/zbuffer.h"
#include "math/rigid.h"
#include "tracking/tracker.h"

namespace vitruvia {

// A mannequin before a camera, its left arm lowered and its right elbow bent by some angle.
class ArmStage {
 public:
  using Skin = void (*)(const std::vector<Vector3f>& rest_vertices, const SkinWeights& weights,
                        const BoneTransforms& posed_from_rest, std::vector<Vector3f>& posed);

  // `subdivisions`: 1 gives about 1,600 vertices, fast and round where a person is; 2 gives 6,400,
  // as dense as a small image's pixels.
  ArmStage(int subdivisions, Skin skin, const Rigidd& camera_from_subject);

  std::vector<Vector3f> Vertices(double angle_rad) const;  // truth, camera frame, metres
  DepthFrame Frame(int index, double angle_rad);           // of 30 a second
  // Mean distance of the result's vertices from the truth, metres.
  double MeanError(const TrackResult& result, double angle_rad) const;

  const BodyModel body;
  const PinholeCamera camera;
  ZBuffer zbuffer{camera};

 private:
  Skin skin_;
  Rigidd camera_from_subject_;
};

}  // namespace vitruvia
