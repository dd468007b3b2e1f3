// Seeded random numbers: named streams of one seed.
//
// Each consumer takes a stream by name, so adding one never shifts the numbers of another. The
// generator and the distributions are our own, hence the same on every platform and library.
#pragma once

#include <cstdint>
#include <string_view>

namespace vitruvia {

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t NextBits();
  double Uniform(double low = 0.0, double high = 1.0);  // in [low, high)
  double Normal(double mean = 0.0, double deviation = 1.0);
  std::uint64_t Index(std::uint64_t count);  // in [0, count), count ≥ 1

 private:
  std::uint64_t state_;
  double spare_normal_ = 0.0;
  bool has_spare_normal_ = false;
};

}  // namespace vitruvia
