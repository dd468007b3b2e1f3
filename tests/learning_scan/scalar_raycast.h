// The raycast of a volume one ray after the other, which that of eight side by side must equal.
#pragma once

#include "learning/scan/tsdf_volume.h"

namespace vitruvia {

PointMap ScalarRaycast(const TsdfVolume& volume, const PinholeCamera& camera,
                       const Rigidd& subject_from_camera);

}  // namespace vitruvia
