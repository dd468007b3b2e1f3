#include "experiments/studies/drawn_parts.h"

namespace vitruvia {
namespace {

// Of an arrow: the shaft's width as a share of the head's, and where the head begins.
constexpr double kShaftWidth = 0.35, kHeadStart = 0.7;
constexpr double kBluntEnd = 0.02;  // base of a part that is a pyramid rather than a spindle

Vector3d AnyNormal(const Vector3d& direction) {
  Eigen::Index smallest = 0;
  direction.cwiseAbs().minCoeff(&smallest);
  return direction.cross(Vector3d::Unit(smallest)).normalized();
}

}  // namespace

TriangleMesh Spindle(const Vector3d& from, const Vector3d& to, double width_m, double base) {
  const Vector3d direction = (to - from).normalized();
  const Vector3d u = AnyNormal(direction), v = direction.cross(u);
  const Vector3d middle = from + base * (to - from);
  const double half_m = 0.5 * width_m;
  TriangleMesh mesh;
  for (const Vector3d& corner : {from, Vector3d(middle + half_m * u), Vector3d(middle + half_m * v),
                                 Vector3d(middle - half_m * u), Vector3d(middle - half_m * v), to})
    mesh.vertices.push_back(corner.cast<float>());
  for (std::int32_t side = 0; side < 4; ++side) {
    const std::int32_t a = 1 + side, b = 1 + (side + 1) % 4;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({5, a, b});
  }
  return mesh;
}

TriangleMesh Arrow(const Vector3d& from, const Vector3d& to, double width_m) {
  TriangleMesh arrow = Spindle(from, to, kShaftWidth * width_m, kBluntEnd);
  Append(Spindle(from + kHeadStart * (to - from), to, width_m, kBluntEnd), arrow);
  return arrow;
}

void Append(const TriangleMesh& part, TriangleMesh& mesh) {
  const auto offset = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Triangle& t : part.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

}  // namespace vitruvia
