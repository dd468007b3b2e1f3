#include "core/calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/timer.h"

namespace vitruvia {
namespace {

constexpr int kPasses = 9;
constexpr std::size_t kCells = std::size_t{1} << 20;  // of 4 bytes: 4 MB
constexpr int kScatteredSteps = 60'000;
constexpr int kArithmeticSteps = 80'000;

// Turns a small vector by slowly changing angles: products, sums and a root that wait for each
// other, as forward kinematics and normal equations do.
double Arithmetic() {
  double x = 1.0, y = 0.0, z = 0.5;
  for (int i = 0; i < kArithmeticSteps; ++i) {
    const double c = 0.99995, s = 0.0099998;
    const double next_x = c * x - s * y;
    y = s * x + c * y;
    x = c * next_x + s * z;
    z = c * z - s * next_x;
    const double inverse_length = 1.0 / std::sqrt(x * x + y * y + z * z);
    x *= inverse_length;
    y *= inverse_length;
    z *= inverse_length;
  }
  return x + y + z;
}

// Each step's address depends on what the last one read, as in a tree's descent.
std::uint32_t ScatteredMemory(std::vector<std::uint32_t>& cells) {
  std::uint32_t at = 1;
  for (int i = 0; i < kScatteredSteps; ++i) {
    std::uint32_t& cell = cells[at & (kCells - 1)];
    cell = cell * 1664525u + 1013904223u + at;
    at = cell >> 7;
  }
  return at;
}

}  // namespace

double CalibrationMs() {
  std::vector<std::uint32_t> cells(kCells, 1);
  volatile double kept = 0.0;  // or the work would be optimised away
  std::array<double, kPasses> ms{};
  for (double& pass_ms : ms) {
    const Stopwatch watch;
    kept = kept + Arithmetic() + ScatteredMemory(cells);
    pass_ms = watch.ElapsedMs();
  }
  std::nth_element(ms.begin(), ms.begin() + kPasses / 2, ms.end());
  return ms[kPasses / 2];
}

}  // namespace vitruvia
