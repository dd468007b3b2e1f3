// Pose-dependent deformation of a body's triangles (SCAPE: Anguelov et al. 2005, sec. 4; the Q of
// paper A, eq. 1), learnt by regression from examples of people in many poses.
//
// Every triangle belongs to one part, the bone with the largest weight, and depends on the two
// joints of that part nearest to it. Its deformation beyond the part's rotation is linear in the
// joints' rotation vectors: Q = C_0 + Σ_{c, i} Δr_c,i C_c,i, each C a 3 × 3 matrix in the axes of
// the rest pose. Δr_c = Log(R_parentᵀ R_bone).
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "config/settings.h"
#include "learning/shape/body_database.h"

namespace vitruvia {

inline constexpr int kRegressionJoints = 2;                    // that a triangle depends on
inline constexpr int kRegressors = 1 + 3 * kRegressionJoints;  // constant first

struct PoseRegressionSettings {
  double smoothness = 1e-3;
  double ridge = 0.02;

  void Describe(Fields& fields);
};

// The deformations of one triangle.
struct TrianglePoseModel {
  int bone = 0;                                   // its part
  std::array<int, kRegressionJoints> joints{};    // as indices of their bones; −1: none
  Vector3f place = Vector3f::Zero();              // of its centroid, see PlaceOnBone
  std::array<Matrix3<float>, kRegressors> terms;  // C_0, then three for each joint

  TrianglePoseModel() { terms.fill(Matrix3<float>::Zero()); }
};

// Q of one triangle, Δr as below.
Matrix3<double> DeformationOf(const TrianglePoseModel& model,
                              const std::array<Vector3d, kBoneCount>& turns);

struct PoseRegression {
  std::vector<TrianglePoseModel> triangles;  // of the mesh that was learnt on
};

// The rotation vector of each bone relative to its parent; zero for the pelvis.
std::array<Vector3d, kBoneCount> JointRotationVectors(
    const std::array<Matrix3<double>, kBoneCount>& rotations);

// Normalised position of a point on a bone, comparable between people of different sizes: relative
// to the bone's joint, in units of its length.
Vector3f PlaceOnBone(const Skeleton& skeleton, int bone, const Vector3f& point);

// The bone of each triangle: of the largest summed weight of its corners.
std::vector<int> TriangleBones(const std::vector<Triangle>& triangles, const SkinWeights& weights);

// One person's rest pose and the same surface in other poses.
struct PosedPerson {
  Skeleton skeleton;
  std::vector<Vector3f> rest;
  std::vector<std::vector<Vector3f>> poses;
};

// The best rotation of each bone's triangles (their corners' rigid motion from rest to pose).
std::array<Matrix3<double>, kBoneCount> PartRotations(const std::vector<Triangle>& triangles,
                                                      const std::vector<int>& bones,
                                                      const std::vector<Vector3f>& rest,
                                                      const std::vector<Vector3f>& posed);

// The triangles' Q in a pose: min Σ_k Σ_j |R Q_k ê_kj − e_kj|² + smoothness · ē² Σ_{k~l} |Q_k −
// Q_l|² over neighbours of one part, ē² the mean squared edge length. A triangle's edges do not
// determine Q along its normal; there the smoothness term does.
class PoseDeformations {
 public:
  PoseDeformations(const std::vector<Triangle>& triangles, const std::vector<int>& bones,
                   const std::vector<Vector3f>& rest, double smoothness);
  ~PoseDeformations();

  std::vector<Matrix3<double>> Of(const std::array<Matrix3<double>, kBoneCount>& rotations,
                                  const std::vector<Vector3f>& posed) const;

 private:
  struct Factorization;
  std::unique_ptr<Factorization> factorization_;
};

// The people's surfaces must have the reference's triangles.
PoseRegression LearnPoseRegression(const BodyModel& reference,
                                   const std::vector<PosedPerson>& people,
                                   const PoseRegressionSettings& settings);

// Transfers the model to another mesh: each triangle takes the model of the learnt triangle of the
// same bone with the nearest PlaceOnBone. DataError if a bone of the mesh has no triangle in the
// model.
PoseRegression OnMesh(const PoseRegression& regression, const BodyModel& body);

// On disk, a folder: regression.json and triangles.bin. DataError naming what is damaged.
inline constexpr const char* kPoseRegressionFile = "regression.json";
void WritePoseRegression(const std::filesystem::path& folder, const PoseRegression& regression,
                         const nlohmann::json& learnt_from);
PoseRegression ReadPoseRegression(const std::filesystem::path& folder);
nlohmann::json ReadRegressionOrigin(const std::filesystem::path& folder);  // learnt_from

}  // namespace vitruvia
