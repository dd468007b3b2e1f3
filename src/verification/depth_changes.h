// Depth images as they would be had something been done otherwise. For this module's own files.
#pragma once

#include "geometry/camera.h"
#include "geometry/image.h"

namespace vitruvia {

DepthImage WithSwappedBytes(const DepthImage& depth, double unit_m);  // of the stored 16-bit values
DepthImage MirroredSideways(const DepthImage& depth);
DepthImage TurnedUpsideDown(const DepthImage& depth);  // rows in reverse
DepthImage TurnedHalfRound(const DepthImage& depth);   // both
DepthImage Scaled(const DepthImage& depth, double factor);
// Values taken for distances from the camera's centre instead of depth along z.
DepthImage FromRayLengths(const DepthImage& lengths, const PinholeCamera& camera);

}  // namespace vitruvia
