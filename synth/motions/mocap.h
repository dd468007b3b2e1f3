// Motion capture retargeted to a body.
//
// Both start with the pelvis above the origin and facing +z, and play from the file's first frame
// at its own rate. DataError naming the file (and line) if it is missing or damaged, or if its
// joints are not those of a human.
#pragma once

#include "synth/motions/motion.h"

namespace vitruvia {

// The CMU database's format: skeleton and motion in separate files, 120 frames per second.
std::unique_ptr<Motion> LoadAsfAmc(const std::filesystem::path& amc,
                                   const std::filesystem::path& asf, const Skeleton& skeleton);

std::unique_ptr<Motion> LoadBvh(const std::filesystem::path& bvh, const Skeleton& skeleton);

}  // namespace vitruvia
