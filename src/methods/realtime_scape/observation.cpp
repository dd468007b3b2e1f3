#include "methods/realtime_scape/observation.h"

#include "geometry/flying_pixels.h"

namespace vitruvia::realtime_scape {

Observer::Observer(const PinholeCamera& camera, const Settings& settings)
    : camera_(camera), settings_(settings.cloud) {
  observation_.near_cloud =
      MakeNearestNeighbors(settings.fit.association, camera, settings.fit.window_px);
}

const Observation& Observer::Observe(const DepthImage& depth) {
  observation_.depth = &depth;
  if (settings_.least_neighbors > 0) {
    RemoveFlyingPixels(depth, settings_.least_neighbors,
                       static_cast<float>(settings_.neighbor_within_m), without_flying_);
    observation_.depth = &without_flying_;
  }
  CloudFromDepth(*observation_.depth, camera_, settings_.stride,
                 static_cast<float>(settings_.max_depth_m), observation_.cloud);
  if (!observation_.cloud.points.empty()) observation_.near_cloud->Build(observation_.cloud.points);
  return observation_;
}

}  // namespace vitruvia::realtime_scape
