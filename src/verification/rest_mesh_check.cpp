#include "verification/rest_mesh_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/statistics.h"
#include "search/kd_tree.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

constexpr std::size_t kProbes = 300;       // vertices of the subject that are compared
constexpr std::size_t kTreePoints = 6000;  // vertices of the rest mesh that they are compared with
constexpr float kFarAway_m = 3.0f;         // farther counts as this far

std::vector<Vector3f> EveryNth(const std::vector<Vector3f>& points, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (points.size() + most - 1) / most);
  std::vector<Vector3f> some;
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  return some;
}

// Of the vertices that triangles have.
Eigen::AlignedBox3d Bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle)
      box.extend(mesh.vertices[static_cast<std::size_t>(v)].cast<double>().eval());
  }
  return box;
}

std::optional<Finding> UnusedProblem(const TriangleMesh& mesh, const std::string& name) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t v : triangle) is_used[static_cast<std::size_t>(v)] = true;
  }
  const auto unused = std::count(is_used.begin(), is_used.end(), false);
  if (unused == 0) return std::nullopt;
  return Warning(
      "{}: {} of {} vertices are in no triangle, vertex {} the first of them; errors are "
      "taken over them too",
      name, unused, is_used.size(),
      std::find(is_used.begin(), is_used.end(), false) - is_used.begin());
}

// How far the subject's vertices are from the rest mesh.
struct Misfit {
  double mean_m = 0.0, median_m = 0.0, nearly_all_m = 0.0;
  bool IsSmall() const {
    return median_m <= kRestMedianWithin_m && nearly_all_m <= kRestNearlyAllWithin_m;
  }
};

class RestComparison {
 public:
  RestComparison(const std::vector<Vector3f>& true_rest, const std::vector<Vector3f>& subject)
      : probes_(EveryNth(subject, kProbes)) {
    tree_.Build(EveryNth(true_rest, kTreePoints));
  }

  // After the rest mesh is put right by p → map p + shift, so the probes by the inverse.
  Misfit After(const Matrix3<double>& map, const Vector3d& shift) const {
    std::vector<Vector3f> queries;
    for (const Vector3f& p : probes_)
      queries.push_back((map.transpose() * (p.cast<double>() - shift)).cast<float>());
    std::vector<KdTree::Neighbor> neighbors;
    tree_.FindNearest(queries, kFarAway_m, neighbors);
    std::vector<double> distances;
    for (const KdTree::Neighbor& n : neighbors)
      distances.push_back(n.index < 0 ? kFarAway_m : std::sqrt(n.squared_distance));
    return {Mean(distances), Quantile(distances, 0.5), Quantile(distances, 0.95)};
  }

 private:
  std::vector<Vector3f> probes_;
  KdTree tree_;
};

std::string Evidence(const Misfit& misfit) {
  return fmt::format(
      "the subject's vertices are {:.3f} m from it in the median and {:.3f} m at the 95th "
      "percentile (expected at most {:g} and {:g})",
      misfit.median_m, misfit.nearly_all_m, kRestMedianWithin_m, kRestNearlyAllWithin_m);
}

// To centimetres, and never −0.
double Rounded(double metres) { return std::round(100.0 * metres) / 100.0 + 0.0; }

// What puts the rest mesh in the subject's place.
std::string CauseOf(const RestComparison& comparison, const Eigen::AlignedBox3d& rest,
                    const Eigen::AlignedBox3d& subject) {
  const Vector3d shift = subject.center() - rest.center();
  if (comparison.After(Matrix3<double>::Identity(), shift).IsSmall())
    return fmt::format(
        "it stands ({:.2f}, {:.2f}, {:.2f}) m away from the subject (x left, y up, "
        "z front); move it there",
        Rounded(-shift.x()), Rounded(-shift.y()), Rounded(-shift.z()));
  const auto about = [&](const AxisMap& map, bool centered) -> Misfit {
    const Vector3d moved = centered
                               ? Vector3d(subject.center() - map.expected_from_file * rest.center())
                               : Vector3d::Zero();
    return comparison.After(map.expected_from_file, moved);
  };
  for (const bool centered : {false, true}) {
    const AxisMap* best = nullptr;
    Misfit least;
    for (const AxisMap& map : AxisMaps()) {
      const Misfit misfit = about(map, centered);
      if (best != nullptr && misfit.mean_m >= least.mean_m) continue;
      best = &map;
      least = misfit;
    }
    if (least.IsSmall())
      return fmt::format("{}{}", AxisCause(*best, AxesOf::kSubject),
                         centered ? ", and in another place" : "");
  }
  return "another pose or another person?";
}

// A rotated body occupies nearly the same space, so rotations need a direct comparison.
std::optional<Finding> TurnProblem(const RestComparison& comparison, const Misfit& as_is,
                                   const std::string& name) {
  if (as_is.mean_m < kTurnedRestError_m) return std::nullopt;
  for (const AxisMap& map : AxisMaps()) {
    const Eigen::Vector3d signs = map.expected_from_file.diagonal();
    if (signs.y() != 1.0 || signs.z() != -1.0) continue;
    const Misfit turned = comparison.After(map.expected_from_file, Vector3d::Zero());
    if (turned.mean_m < 0.5 * as_is.mean_m)
      return Impossible(
          "{}: {}: the subject is {:.3f} m from it on average, and {:.3f} m once it "
          "is put right",
          name, AxisCause(map, AxesOf::kSubject), as_is.mean_m, turned.mean_m);
  }
  return std::nullopt;
}

}  // namespace

Findings CheckRestMesh(const TriangleMesh& true_rest, const BodyModel& subject,
                       const std::string& name) {
  const Eigen::AlignedBox3d rest = Bounds(true_rest);
  const Eigen::AlignedBox3d body = Bounds(subject.rest);
  const double ratio = rest.diagonal().norm() / body.diagonal().norm();
  if (std::abs(ratio - 1.0) > kRestScaleWithin)
    return {
        Impossible("{}: the rest mesh is {} for the subject: {:.4g} m across, the subject "
                   "{:.4g} m{}",
                   name, TimesTooLarge(ratio), rest.diagonal().norm(), body.diagonal().norm(),
                   LengthUnitCause(ratio))};
  const RestComparison comparison(true_rest.vertices, subject.rest.vertices);
  const Misfit as_is = comparison.After(Matrix3<double>::Identity(), Vector3d::Zero());
  if (!as_is.IsSmall())
    return {Impossible("{}: the rest mesh is not where the subject is: {}: {}", name,
                       Evidence(as_is), CauseOf(comparison, rest, body))};
  if (EnclosedVolume(true_rest) < -kVolumeShare * EnclosedVolume(subject.rest))
    return {Impossible("{}: the triangles face inwards (volume {:.3f} m³); is the mesh mirrored?",
                       name, EnclosedVolume(true_rest))};
  if (const auto problem = TurnProblem(comparison, as_is, name)) return {*problem};
  if (const auto problem = UnusedProblem(true_rest, name)) return {*problem};
  return {};
}

}  // namespace vitruvia
