#include "core/random.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/hash.h"

namespace vitruvia {

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : state_(Hash64().Add(name).Add(&seed, sizeof(seed)).value()) {}

// SplitMix64 (Steele, Lea & Flood 2014).
std::uint64_t RandomStream::NextBits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double RandomStream::Uniform(double low, double high) {
  const double value = low + (high - low) * static_cast<double>(NextBits() >> 11) * 0x1.0p-53;
  return value < high ? value : std::nextafter(high, low);  // the sum may round up to the end
}

// Box and Muller 1958; the second number of a pair is kept for the next call.
double RandomStream::Normal(double mean, double deviation) {
  if (has_spare_normal_) {
    has_spare_normal_ = false;
    return mean + deviation * spare_normal_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
  const double angle = 2.0 * std::numbers::pi * Uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_normal_ = true;
  return mean + deviation * radius * std::cos(angle);
}

std::uint64_t RandomStream::Index(std::uint64_t count) {
  Require(count >= 1, "RandomStream::Index: count is 0");
  return static_cast<std::uint64_t>(Uniform() * static_cast<double>(count));
}

}  // namespace vitruvia
