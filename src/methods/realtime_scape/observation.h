// Line 2 of algorithm 1 (paper A): the frame's points P with a search structure.
#pragma once

#include <memory>

#include "geometry/point_cloud.h"
#include "methods/realtime_scape/settings.h"
#include "search/nearest_neighbors.h"

namespace vitruvia::realtime_scape {

struct Observation {
  const DepthImage* depth = nullptr;  // the frame's, without flying pixels if they are removed
  PointCloud cloud;                   // P
  std::unique_ptr<NearestNeighbors> near_cloud;  // of the cloud's points
};

class Observer {
 public:
  Observer(const PinholeCamera& camera, const Settings& settings);

  // Valid until the next call, and as long as `depth` is.
  const Observation& Observe(const DepthImage& depth);

 private:
  PinholeCamera camera_;
  CloudSettings settings_;
  // Kept between frames to avoid allocation.
  DepthImage without_flying_;
  Observation observation_;
};

}  // namespace vitruvia::realtime_scape
