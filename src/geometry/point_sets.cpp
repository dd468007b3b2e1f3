#include "geometry/point_sets.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitruvia {
namespace {

// The i-th number of the van der Corput sequence of a base: evenly spread in 0 … 1.
double VanDerCorput(int i, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

}  // namespace

Vector3d Centroid(const std::vector<Vector3f>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

OrientedPoints EvenlyChosen(const OrientedPoints& all, int count) {
  const std::size_t size = all.points.size();
  const std::size_t wanted = std::min(size, static_cast<std::size_t>(count));
  OrientedPoints chosen;
  for (std::size_t i = 0; i < wanted; ++i) {
    chosen.points.push_back(all.points[i * size / wanted]);
    chosen.normals.push_back(all.normals[i * size / wanted]);
  }
  return chosen;
}

OrientedPoints SampleSurface(const TriangleMesh& mesh, int count) {
  std::vector<double> area_up_to{0.0};
  for (const Triangle& t : mesh.triangles) {
    const Vector3f& a = mesh.vertices[t[0]];
    area_up_to.push_back(
        area_up_to.back() +
        double{0.5f * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm()});
  }
  if (!(area_up_to.back() > 0.0)) throw DataError("the mesh has no triangle with an area");
  std::vector<Vector3f> normals;
  ComputeVertexNormals(mesh.vertices, mesh.triangles, normals);
  OrientedPoints samples;
  for (int i = 0; i < count; ++i) {
    const double at = (i + 0.5) / count * area_up_to.back();
    const auto triangle = static_cast<std::size_t>(
        std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, at) - area_up_to.begin() - 1);
    const Triangle& t = mesh.triangles[triangle];
    const double root = std::sqrt(VanDerCorput(i + 1, 2)), second = VanDerCorput(i + 1, 3);
    const auto b0 = static_cast<float>(1.0 - root), b1 = static_cast<float>(root * (1.0 - second)),
               b2 = static_cast<float>(root * second);
    samples.points.push_back(b0 * mesh.vertices[t[0]] + b1 * mesh.vertices[t[1]] +
                             b2 * mesh.vertices[t[2]]);
    samples.normals.push_back(
        (b0 * normals[t[0]] + b1 * normals[t[1]] + b2 * normals[t[2]]).normalized());
  }
  return samples;
}

}  // namespace vitruvia
