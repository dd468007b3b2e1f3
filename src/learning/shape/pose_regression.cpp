#include "learning/shape/pose_regression.h"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "core/error.h"
#include "core/progress.h"
#include "geometry/half_edges.h"
#include "math/rigid_fit.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

std::array<Vector3d, 2> EdgesOf(const std::vector<Vector3f>& vertices, const Triangle& t) {
  const Vector3d a = vertices[t[0]].cast<double>();
  return {vertices[t[1]].cast<double>() - a, vertices[t[2]].cast<double>() - a};
}

Vector3f CentroidOf(const std::vector<Vector3f>& vertices, const Triangle& t) {
  return (vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3.0f;
}

// Pairs of triangles that share an edge.
std::vector<std::array<int, 2>> NeighbouringTriangles(const std::vector<Triangle>& triangles,
                                                      std::size_t vertex_count) {
  const HalfEdges half_edges = FindHalfEdges(triangles, vertex_count);
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t h = 0; h < half_edges.twin.size(); ++h) {
    const int twin = half_edges.twin[h];
    if (twin > static_cast<int>(h)) pairs.push_back({static_cast<int>(h) / 3, twin / 3});
  }
  return pairs;
}

// The joints of each bone's part: its own, and those of the bones that it carries.
std::vector<int> JointsOfPart(int bone) {
  std::vector<int> joints;
  if (Bones()[bone].parent >= 0) joints.push_back(bone);
  for (int b = 0; b < kBoneCount; ++b) {
    if (Bones()[b].parent == bone) joints.push_back(b);
  }
  return joints;
}

std::array<int, kRegressionJoints> NearestJoints(const Skeleton& skeleton, int bone,
                                                 const Vector3f& centroid) {
  std::vector<int> joints = JointsOfPart(bone);
  std::stable_sort(joints.begin(), joints.end(), [&](int a, int b) {
    return (skeleton.joints[a] - centroid.cast<double>()).squaredNorm() <
           (skeleton.joints[b] - centroid.cast<double>()).squaredNorm();
  });
  std::array<int, kRegressionJoints> nearest;
  nearest.fill(-1);
  for (std::size_t i = 0; i < std::min<std::size_t>(joints.size(), kRegressionJoints); ++i)
    nearest[i] = joints[i];
  return nearest;
}

// What Q is linear in: a constant and the rotation vectors of the triangle's joints.
using Regressors = Eigen::Matrix<double, kRegressors, 1>;
Regressors RegressorsOf(const std::array<int, kRegressionJoints>& joints,
                        const std::array<Vector3d, kBoneCount>& turns) {
  Regressors regressors = Regressors::Zero();
  regressors[0] = 1.0;
  for (int c = 0; c < kRegressionJoints; ++c) {
    if (joints[c] >= 0) regressors.segment<3>(1 + 3 * c) = turns[joints[c]];
  }
  return regressors;
}

// Sums of a triangle's ridge regression.
struct RegressionSums {
  Eigen::Matrix<double, kRegressors, kRegressors> second =
      Eigen::Matrix<double, kRegressors, kRegressors>::Zero();
  Eigen::Matrix<double, kRegressors, 9> cross = Eigen::Matrix<double, kRegressors, 9>::Zero();

  void Add(const Regressors& regressors, const Matrix3<double>& q) {
    second += regressors * regressors.transpose();
    const Matrix3<double> change = q - Matrix3<double>::Identity();
    cross += regressors * Eigen::Map<const Eigen::Matrix<double, 1, 9>>(change.data());
  }
  // Towards the identity.
  std::array<Matrix3<float>, kRegressors> Solve(double ridge) const {
    Eigen::Matrix<double, kRegressors, kRegressors> damped = second;
    damped.diagonal().array() += ridge * second(0, 0);
    const Eigen::Matrix<double, kRegressors, 9> solution = damped.ldlt().solve(cross);
    std::array<Matrix3<float>, kRegressors> terms;
    for (int r = 0; r < kRegressors; ++r) {
      const Eigen::Matrix<double, 1, 9> row = solution.row(r);
      terms[r] = Eigen::Map<const Matrix3<double>>(row.data()).cast<float>();
    }
    terms[0] += Matrix3<float>::Identity();
    return terms;
  }
};

}  // namespace

void PoseRegressionSettings::Describe(Fields& f) {
  f.Number("smoothness", smoothness,
           {.meaning = "weight of the difference of neighbouring triangles' deformations, against "
                       "squared edges of mean length",
            .min = 1e-9,
            .max = 1e3,
            .origin = Origin::kGuessed,
            .source = "Anguelov et al. 2005 smooth too; recalled, their number is open"});
  f.Number("ridge", ridge,
           {.meaning = "ridge of the regression, as a share of the number of examples",
            .min = 1e-9,
            .max = 1e3,
            .origin = Origin::kGuessed,
            .source = "needed with fewer than seven spread poses"});
}

Matrix3<double> DeformationOf(const TrianglePoseModel& model,
                              const std::array<Vector3d, kBoneCount>& turns) {
  const Regressors regressors = RegressorsOf(model.joints, turns);
  Matrix3<double> q = Matrix3<double>::Zero();
  for (int r = 0; r < kRegressors; ++r) q += regressors[r] * model.terms[r].cast<double>();
  return q;
}

std::array<Vector3d, kBoneCount> JointRotationVectors(
    const std::array<Matrix3<double>, kBoneCount>& rotations) {
  std::array<Vector3d, kBoneCount> turns;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    turns[b] = parent < 0 ? Vector3d::Zero().eval()
                          : LogSo3<double>(rotations[parent].transpose() * rotations[b]);
  }
  return turns;
}

Vector3f PlaceOnBone(const Skeleton& skeleton, int bone, const Vector3f& point) {
  const double length_m = (skeleton.tips[bone] - skeleton.joints[bone]).norm();
  return ((point.cast<double>() - skeleton.joints[bone]) / std::max(1e-6, length_m)).cast<float>();
}

std::vector<int> TriangleBones(const std::vector<Triangle>& triangles, const SkinWeights& weights) {
  std::vector<int> bones;
  for (const Triangle& t : triangles) {
    std::array<float, kBoneCount> sums{};
    for (const int v : t) {
      for (int k = 0; k < kMaxInfluences; ++k) sums[weights.bones[v][k]] += weights.weights[v][k];
    }
    bones.push_back(static_cast<int>(std::max_element(sums.begin(), sums.end()) - sums.begin()));
  }
  return bones;
}

std::array<Matrix3<double>, kBoneCount> PartRotations(const std::vector<Triangle>& triangles,
                                                      const std::vector<int>& bones,
                                                      const std::vector<Vector3f>& rest,
                                                      const std::vector<Vector3f>& posed) {
  std::array<std::vector<int>, kBoneCount> corners;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    corners[bones[k]].insert(corners[bones[k]].end(), triangles[k].begin(), triangles[k].end());
  std::array<Matrix3<double>, kBoneCount> rotations;
  for (int b = 0; b < kBoneCount; ++b) {
    if (corners[b].empty()) {
      const int parent = Bones()[b].parent;
      rotations[b] = parent < 0 ? Matrix3<double>::Identity().eval() : rotations[parent];
      continue;
    }
    rotations[b] = FitRigid(corners[b].size(), [&](std::size_t i) {
                     const int v = corners[b][i];
                     return PointPair{rest[v].cast<double>(), posed[v].cast<double>()};
                   }).rotation;
  }
  return rotations;
}

struct PoseDeformations::Factorization {
  std::vector<Triangle> triangles;
  std::vector<int> bones;
  std::vector<std::array<Vector3d, 2>> edges;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
};

PoseDeformations::PoseDeformations(const std::vector<Triangle>& triangles,
                                   const std::vector<int>& bones, const std::vector<Vector3f>& rest,
                                   double smoothness)
    : factorization_(std::make_unique<Factorization>()) {
  Factorization& f = *factorization_;
  f.triangles = triangles;
  f.bones = bones;
  double mean_square = 0.0;
  for (const Triangle& t : triangles) {
    f.edges.push_back(EdgesOf(rest, t));
    mean_square += f.edges.back()[0].squaredNorm() + f.edges.back()[1].squaredNorm();
  }
  mean_square /= 2.0 * static_cast<double>(triangles.size());
  // A row of each Q: three unknowns for each triangle, the same system for all three rows.
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    Matrix3<double> block = Matrix3<double>::Zero();
    for (const Vector3d& edge : f.edges[k]) block += edge * edge.transpose();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) entries.emplace_back(3 * k + i, 3 * k + j, block(i, j));
    }
  }
  const double weight = smoothness * mean_square;
  for (const auto& [k, l] : NeighbouringTriangles(triangles, rest.size())) {
    if (bones[k] != bones[l]) continue;
    for (int i = 0; i < 3; ++i) {
      entries.insert(entries.end(), {{3 * k + i, 3 * k + i, weight},
                                     {3 * l + i, 3 * l + i, weight},
                                     {3 * k + i, 3 * l + i, -weight},
                                     {3 * l + i, 3 * k + i, -weight}});
    }
  }
  // A part of one flat patch would leave the normal's direction free.
  for (int i = 0; i < static_cast<int>(3 * triangles.size()); ++i)
    entries.emplace_back(i, i, 1e-6 * mean_square);
  const auto n = static_cast<Eigen::Index>(3 * triangles.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  f.solver.compute(matrix);
  if (f.solver.info() != Eigen::Success)
    throw DataError("pose regression: the system of a person's triangles is singular");
}

PoseDeformations::~PoseDeformations() = default;

std::vector<Matrix3<double>> PoseDeformations::Of(
    const std::array<Matrix3<double>, kBoneCount>& rotations,
    const std::vector<Vector3f>& posed) const {
  const Factorization& f = *factorization_;
  const auto n = static_cast<Eigen::Index>(3 * f.triangles.size());
  // Of Q − I, which the small term on the diagonal draws to zero.
  Eigen::MatrixX3d right_side = Eigen::MatrixX3d::Zero(n, 3);
  for (std::size_t k = 0; k < f.triangles.size(); ++k) {
    const std::array<Vector3d, 2> edges = EdgesOf(posed, f.triangles[k]);
    for (int e = 0; e < 2; ++e) {
      const Vector3d change =
          rotations[f.bones[k]].transpose() * edges[e] - f.edges[k][e];  // (Q − I) ê
      right_side.middleRows<3>(static_cast<Eigen::Index>(3 * k)) +=
          f.edges[k][e] * change.transpose();
    }
  }
  const Eigen::MatrixX3d solution = f.solver.solve(right_side);
  std::vector<Matrix3<double>> q(f.triangles.size());
  for (std::size_t k = 0; k < q.size(); ++k) {
    q[k] = Matrix3<double>::Identity() +
           solution.middleRows<3>(static_cast<Eigen::Index>(3 * k)).transpose();
  }
  return q;
}

PoseRegression LearnPoseRegression(const BodyModel& reference,
                                   const std::vector<PosedPerson>& people,
                                   const PoseRegressionSettings& settings) {
  const std::vector<Triangle>& triangles = reference.rest.triangles;
  const std::vector<int> bones = TriangleBones(triangles, reference.weights);
  PoseRegression regression;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    TrianglePoseModel model;
    model.bone = bones[k];
    const Vector3f centroid = CentroidOf(reference.rest.vertices, triangles[k]);
    model.joints = NearestJoints(reference.skeleton, bones[k], centroid);
    model.place = PlaceOnBone(reference.skeleton, bones[k], centroid);
    regression.triangles.push_back(model);
  }
  int poses = 0;
  for (const PosedPerson& person : people) poses += static_cast<int>(person.poses.size());
  Progress progress("pose examples", poses);
  std::vector<RegressionSums> sums(triangles.size());
  for (const PosedPerson& person : people) {
    const PoseDeformations deformations(triangles, bones, person.rest, settings.smoothness);
    for (const std::vector<Vector3f>& posed : person.poses) {
      ThrowIfInterrupted();
      const auto rotations = PartRotations(triangles, bones, person.rest, posed);
      const auto turns = JointRotationVectors(rotations);
      const std::vector<Matrix3<double>> q = deformations.Of(rotations, posed);
      for (std::size_t k = 0; k < q.size(); ++k)
        sums[k].Add(RegressorsOf(regression.triangles[k].joints, turns), q[k]);
      progress.Advance();
    }
  }
  for (std::size_t k = 0; k < triangles.size(); ++k)
    regression.triangles[k].terms = sums[k].Solve(settings.ridge);
  return regression;
}

PoseRegression OnMesh(const PoseRegression& regression, const BodyModel& body) {
  std::array<std::vector<const TrianglePoseModel*>, kBoneCount> of_bone;
  for (const TrianglePoseModel& model : regression.triangles) of_bone[model.bone].push_back(&model);
  const std::vector<int> bones = TriangleBones(body.rest.triangles, body.weights);
  PoseRegression on_mesh;
  for (std::size_t k = 0; k < bones.size(); ++k) {
    if (of_bone[bones[k]].empty()) {
      throw DataError(fmt::format("pose regression: no triangle of bone {} was learnt",
                                  Bones()[bones[k]].name));
    }
    const Vector3f place = PlaceOnBone(body.skeleton, bones[k],
                                       CentroidOf(body.rest.vertices, body.rest.triangles[k]));
    on_mesh.triangles.push_back(**std::min_element(
        of_bone[bones[k]].begin(), of_bone[bones[k]].end(),
        [&](const TrianglePoseModel* a, const TrianglePoseModel* b) {
          return (a->place - place).squaredNorm() < (b->place - place).squaredNorm();
        }));
  }
  return on_mesh;
}

}  // namespace vitruvia
