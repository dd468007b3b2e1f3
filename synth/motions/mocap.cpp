#include "synth/motions/mocap.h"

#include "synth/motions/asf_amc.h"
#include "synth/motions/bvh.h"
#include "synth/motions/mocap_retarget.h"

namespace vitruvia {

std::unique_ptr<Motion> LoadAsfAmc(const std::filesystem::path& amc,
                                   const std::filesystem::path& asf, const Skeleton& skeleton) {
  return Retarget(ReadAsfAmc(amc, asf), skeleton);
}

std::unique_ptr<Motion> LoadBvh(const std::filesystem::path& bvh, const Skeleton& skeleton) {
  return Retarget(ReadBvh(bvh), skeleton);
}

}  // namespace vitruvia
