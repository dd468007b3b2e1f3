// Depth images transformed as common mistakes would transform them. Internal to this module.
#pragma once

#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

DepthImage WithSwappedBytes(const DepthImage& depth, double unit_m);  // of the stored 16-bit values
DepthImage MirroredSideways(const DepthImage& depth);
DepthImage TurnedUpsideDown(const DepthImage& depth);  // rows in reverse
DepthImage TurnedHalfRound(const DepthImage& depth);   // both
DepthImage Scaled(const DepthImage& depth, double factor);
// Depth along z, if the values are distances from the camera's centre.
DepthImage FromRayLengths(const DepthImage& lengths, const PinholeCamera& camera);

}  // namespace vitruvia
