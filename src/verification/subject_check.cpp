#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "verification/checks.h"
#include "verification/likely_cause.h"
#include "verification/limits.h"

namespace vitruvia {
namespace {
using namespace verification_limits;

const Vector3d& Joint(const Skeleton& skeleton, BoneId bone) {
  return skeleton.joints[static_cast<std::size_t>(bone)];
}
const Vector3d& Tip(const Skeleton& skeleton, BoneId bone) {
  return skeleton.tips[static_cast<std::size_t>(bone)];
}

double SkeletonDiagonal(const Skeleton& skeleton) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& joint : skeleton.joints) box.extend(joint);
  for (const Vector3d& tip : skeleton.tips) box.extend(tip);
  return box.diagonal().norm();
}

bool IsHuman(double diagonal_m) {
  return diagonal_m >= kSmallestBody_m && diagonal_m <= kLargestBody_m;
}

// If mesh and bones differ in size, height_m decides which of them is wrong.
std::optional<Finding> SizeProblem(double mesh_m, double bones_m, double height_m) {
  const double ratio = bones_m / mesh_m;
  const bool agree = ratio >= kSkeletonOfMeshLeast && ratio <= kSkeletonOfMeshMost;
  if (agree && IsHuman(mesh_m)) return std::nullopt;
  const double expected_m = kDiagonalOfHeight * height_m;
  const auto off = [&](double size_m) { return std::abs(std::log(size_m / expected_m)); };
  if (off(bones_m) > off(mesh_m))
    return Impossible(
        "subject.json: the bones are {} for the mesh: {:.4g} m across where mesh.ply has {:.4g} "
        "m{}",
        TimesTooLarge(ratio), bones_m, mesh_m, LengthUnitCause(ratio));
  return Impossible(
      "mesh.ply: the mesh is {} for a person of height_m {:g}: {:.4g} m across, expected about "
      "{:.3g} m; the bones of subject.json are {:.4g} m across{}",
      TimesTooLarge(mesh_m / expected_m), height_m, mesh_m, expected_m, bones_m,
      LengthUnitCause(mesh_m / expected_m));
}

// Rows: the body's left, up and front as its bones have them; the identity if all is right.
Matrix3<double> BodyAxes(const Skeleton& s) {
  const Vector3d feet = 0.5 * (Joint(s, BoneId::kLeftFoot) + Joint(s, BoneId::kRightFoot));
  const Vector3d toes = 0.5 * (Tip(s, BoneId::kLeftFoot) + Tip(s, BoneId::kRightFoot));
  const Vector3d up = (Joint(s, BoneId::kHead) - feet).normalized();
  const Vector3d left =
      (Joint(s, BoneId::kLeftUpperArm) - Joint(s, BoneId::kRightUpperArm)).normalized();
  const Vector3d forward = toes - feet;
  Matrix3<double> axes;
  axes.row(0) = left.transpose();
  axes.row(1) = up.transpose();
  axes.row(2) = (forward - forward.dot(up) * up).normalized().transpose();
  return axes;
}

std::optional<Finding> AxesProblem(const Skeleton& skeleton) {
  const Matrix3<double> axes = BodyAxes(skeleton);
  if (axes.diagonal().minCoeff() > kAxisAlignment) return std::nullopt;
  const std::vector<AxisMap>& maps = AxisMaps();
  const auto best = std::max_element(maps.begin(), maps.end(), [&](const auto& a, const auto& b) {
    return (a.expected_from_file * axes.transpose()).trace() <
           (b.expected_from_file * axes.transpose()).trace();
  });
  const bool sides_only =
      best->expected_from_file.isApprox(Eigen::Vector3d(-1, 1, 1).asDiagonal().toDenseMatrix());
  const auto text = [&](int row) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", axes(row, 0), axes(row, 1), axes(row, 2));
  };
  return Impossible(
      "subject.json: the bones' left is {}, up {} and front {}, expected (1, 0, 0), (0, 1, 0) and "
      "(0, 0, 1): {}{}",
      text(0), text(1), text(2), AxisCause(*best, AxesOf::kSubject),
      sides_only ? ", or left and right are swapped" : "");
}

struct BoneSkin {
  std::array<Vector3d, kBoneCount> centers;  // of the skin, weighted
  std::array<double, kBoneCount> weights{};
};

BoneSkin CentersOfSkin(const BodyModel& body) {
  BoneSkin skin;
  skin.centers.fill(Vector3d::Zero());
  for (std::size_t v = 0; v < body.rest.vertices.size(); ++v) {
    for (std::size_t k = 0; k < body.weights.weights[v].size(); ++k) {
      const auto bone = static_cast<std::size_t>(body.weights.bones[v][k]);
      const double weight = body.weights.weights[v][k];
      skin.centers[bone] += weight * body.rest.vertices[v].cast<double>();
      skin.weights[bone] += weight;
    }
  }
  for (std::size_t b = 0; b < skin.centers.size(); ++b) {
    if (skin.weights[b] > 0.0) skin.centers[b] /= skin.weights[b];
  }
  return skin;
}

// Share of the bones near whose middle their skin lies, once the mesh is turned by `map` and the
// skin of bone b belongs to bone `skin_of(b)`.
template <class SkinOf>
double BonesWithTheirSkin(const BodyModel& body, const BoneSkin& skin, const Matrix3<double>& map,
                          double within_m, const SkinOf& skin_of) {
  int with = 0, counted = 0;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const auto from = static_cast<std::size_t>(skin_of(b));
    if (skin.weights[from] == 0.0) continue;
    ++counted;
    const Vector3d middle = 0.5 * (body.skeleton.joints[b] + body.skeleton.tips[b]);
    with += (map * skin.centers[from] - middle).norm() < within_m ? 1 : 0;
  }
  return counted == 0 ? 1.0 : static_cast<double>(with) / counted;
}

std::optional<Finding> SkinProblem(const BodyModel& body, double mesh_m) {
  const double within_m = kSkinFromBone * mesh_m / kDiagonalOfHeight;
  const BoneSkin skin = CentersOfSkin(body);
  const auto own = [](std::size_t b) { return static_cast<int>(b); };
  const auto mirrored = [](std::size_t b) { return Bones()[b].mirror; };
  const Matrix3<double> as_is = Matrix3<double>::Identity();
  const double share = BonesWithTheirSkin(body, skin, as_is, within_m, own);
  if (share >= kBonesWithTheirSkin) return std::nullopt;
  const std::string evidence = fmt::format(
      "only {:.0f} % of the bones of subject.json lie within {:.2f} m of the skin that weights.bin "
      "gives them",
      100.0 * share, within_m);
  if (BonesWithTheirSkin(body, skin, as_is, within_m, mirrored) >= kBonesWithTheirSkin)
    return Impossible("weights.bin: {}; are left and right swapped?", evidence);
  for (const AxisMap& map : AxisMaps()) {
    if (BonesWithTheirSkin(body, skin, map.expected_from_file, within_m, own) >=
        kBonesWithTheirSkin)
      return Impossible("mesh.ply: {}: {}?", evidence, AxisCause(map, AxesOf::kSubject));
  }
  return Impossible("weights.bin: {}; are its vertices or bones in another order?", evidence);
}

// Whether an axis-parallel ray from the point crosses a closed mesh an odd number of times.
bool IsInside(const Vector3d& point, const TriangleMesh& mesh) {
  int crossings = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]].cast<double>() - point;
    const Vector3d b = mesh.vertices[t[1]].cast<double>() - point;
    const Vector3d c = mesh.vertices[t[2]].cast<double>() - point;
    const auto cross = [](const Vector3d& p, const Vector3d& q) {
      return p.x() * q.y() - p.y() * q.x();
    };
    const double ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
    if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) continue;
    const double z = (bc * a.z() + ca * b.z() + ab * c.z()) / (ab + bc + ca);
    crossings += z > 0.0 ? 1 : 0;
  }
  return crossings % 2 == 1;
}

std::optional<Finding> BonesOutside(const BodyModel& body) {
  // Off the plane of symmetry, where many edges lie.
  const Vector3d aside(1.37e-4, 0.73e-4, 0.0);
  std::vector<std::string_view> outside;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    if (!IsInside(body.skeleton.joints[b] + aside, body.rest)) outside.push_back(Bones()[b].joint);
  }
  if (static_cast<double>(kBoneCount - outside.size()) >= kJointsInside * kBoneCount)
    return std::nullopt;
  return Impossible(
      "subject.json: {} of {} joints lie outside of mesh.ply ({}); are the bones of another mesh, "
      "or moved against it?",
      outside.size(), kBoneCount, fmt::join(outside, ", "));
}

void CheckHeight(const BodyModel& body, Findings& findings) {
  Eigen::AlignedBox3f box;
  for (const Vector3f& v : body.rest.vertices) box.extend(v);
  const double mesh_m = box.sizes().y(), stated_m = body.attributes.height_m;
  const double off = std::abs(mesh_m / stated_m - 1.0);
  const auto text = fmt::format(
      "subject.json: height_m is {:g}, but mesh.ply is {:.3f} m tall; which of the two is another "
      "person's?",
      stated_m, mesh_m);
  if (off > kHeightErrorAbove)
    findings.push_back({Severity::kError, text});
  else if (off > kHeightWarningAbove)
    findings.push_back({Severity::kWarning, text});
  if (std::abs(box.min().y()) > kFloorWithin_m)
    findings.push_back(
        Warning("mesh.ply: the lowest vertex is at y = {:.3f} m, expected the feet "
                "on the floor at 0",
                box.min().y()));
}

}  // namespace

Findings CheckSubject(const BodyModel& body) {
  const double mesh_m = BoundingBoxDiagonal(body.rest.vertices);
  const double bones_m = SkeletonDiagonal(body.skeleton);
  if (const auto problem = SizeProblem(mesh_m, bones_m, body.attributes.height_m))
    return {*problem};
  if (const auto problem = AxesProblem(body.skeleton)) return {*problem};
  if (const auto problem = SkinProblem(body, mesh_m)) return {*problem};
  if (const auto problem = BonesOutside(body)) return {*problem};
  Findings findings;
  CheckHeight(body, findings);
  return findings;
}

}  // namespace vitruvia
