#pragma once

#include <numbers>

#include "core/random.h"
#include "math/rigid.h"
#include "math/rotation.h"

namespace vitruvia {

inline Vector3<double> RandomDirection(RandomStream& random) {
  return Vector3<double>(random.Normal(), random.Normal(), random.Normal()).normalized();
}

inline Rigidd RandomRigid(RandomStream& random) {
  return {ExpSo3<double>(random.Uniform(0.0, std::numbers::pi) * RandomDirection(random)),
          3.0 * RandomDirection(random)};
}

}  // namespace vitruvia
