#include "verification/likely_cause.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kSameFactorWithin = 0.04;

struct LengthUnit {
  double per_metre;
  const char* name;
};
constexpr std::array kLengthUnits = {
    LengthUnit{1000.0, "millimetres"}, LengthUnit{100.0, "centimetres"},
    LengthUnit{10.0, "decimetres"},    LengthUnit{39.3701, "inches"},
    LengthUnit{3.28084, "feet"},       LengthUnit{0.001, "kilometres, or metres divided by 1000"}};

bool IsFactor(double ratio, double factor) {
  return std::abs(ratio / factor - 1.0) < kSameFactorWithin;
}

std::string Factor(double value) {
  for (const double known : {2.0, 5.0, 10.0, 100.0, 1000.0}) {
    if (IsFactor(value, known)) return fmt::format("{:g}", known);
  }
  return fmt::format("{:.3g}", value);
}

// The unit that is meant: one step of 1, 1/2 or 1/5 of a power of ten if one is near.
double PlainUnit(double unit_m) {
  const double power = std::pow(10.0, std::floor(std::log10(unit_m)));
  for (const double step : {1.0, 1.25, 2.0, 2.5, 5.0, 10.0}) {
    if (IsFactor(unit_m, step * power)) return step * power;
  }
  return unit_m;
}

std::string SignedAxis(const Eigen::RowVector3d& row) {
  for (int axis = 0; axis < 3; ++axis) {
    if (row[axis] != 0.0) return fmt::format("{}{}", row[axis] < 0.0 ? "-" : "", "xyz"[axis]);
  }
  return "";
}

}  // namespace

std::string TimesTooLarge(double ratio) {
  return ratio >= 1.0 ? fmt::format("{} times too large", Factor(ratio))
                      : fmt::format("{} times too small", Factor(1.0 / ratio));
}

std::string LengthUnitCause(double ratio) {
  for (const LengthUnit& unit : kLengthUnits) {
    if (IsFactor(ratio, unit.per_metre)) return fmt::format("; are they in {}?", unit.name);
  }
  return "";
}

std::string DepthUnitCause(double ratio, double depth_unit_m) {
  const double meant = PlainUnit(depth_unit_m / ratio);
  return fmt::format("is depth_unit_m {:.4g}{} instead of {:g}?", meant,
                     meant < 1.0 ? fmt::format(" (1/{:.0f} m)", 1.0 / meant) : "", depth_unit_m);
}

const std::vector<AxisMap>& AxisMaps() {
  static const std::vector<AxisMap> maps = [] {
    std::vector<AxisMap> all;
    std::array<int, 3> order = {0, 1, 2};
    do {
      for (int signs = 0; signs < 8; ++signs) {
        Matrix3<double> m = Matrix3<double>::Zero();
        for (int row = 0; row < 3; ++row)
          m(row, order[static_cast<std::size_t>(row)]) = ((signs >> row) & 1) != 0 ? -1.0 : 1.0;
        if (!m.isIdentity()) all.push_back({m});
      }
    } while (std::next_permutation(order.begin(), order.end()));
    return all;
  }();
  return maps;
}

std::string AxisCause(const AxisMap& map, AxesOf frame) {
  const Matrix3<double>& m = map.expected_from_file;
  const bool is_camera = frame == AxesOf::kCamera;
  const Eigen::Vector3d signs = m.diagonal();
  if (signs.cwiseAbs().sum() == 3.0) {  // no axes swapped
    if (signs == Eigen::Vector3d(-1, 1, 1)) return "mirrored left to right: x has the other sign";
    if (signs == Eigen::Vector3d(1, -1, 1))
      return is_camera ? "y is up instead of down" : "upside down: y has the other sign";
    if (signs == Eigen::Vector3d(1, 1, -1))
      return is_camera ? "z is backwards instead of forward"
                       : "mirrored front to back: z has the other sign";
    if (signs == Eigen::Vector3d(1, -1, -1))
      return is_camera ? "y is up and z backwards instead of y down and z forward"
                       : "turned by 180 degrees about x: y and z have the other sign";
    if (signs == Eigen::Vector3d(-1, 1, -1))
      return is_camera ? "turned by 180 degrees about y: x and z have the other sign"
                       : "facing backwards: turned by 180 degrees about y";
    if (signs == Eigen::Vector3d(-1, -1, 1)) return "upside down: turned by 180 degrees about z";
    return "x, y and z all have the other sign";
  }
  const std::string up = SignedAxis(m.row(1));
  return fmt::format("axes swapped: x, y, z seem to be the file's {}, {}, {}{}",
                     SignedAxis(m.row(0)), up, SignedAxis(m.row(2)),
                     !is_camera && up == "z" ? " (z up instead of y up)" : "");
}

}  // namespace vitruvia
