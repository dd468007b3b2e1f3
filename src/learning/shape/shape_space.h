// The space of body shapes (paper A, sec. 4: Θ = U θ + μ), learnt from a body database.
//
// Both forms result in a linear model of vertices, because SCAPE's mesh solve is linear in Θ in the
// rest pose (Q = I): v = mean + basis · θ, with θ in standard deviations of the database's people.
// Surfaces are centred: the mean of a body's vertices is the origin until PlacedBody() sets its
// feet on the floor.
#pragma once

#include <filesystem>

#include "config/settings.h"
#include "learning/shape/body_database.h"

namespace vitruvia {

enum class ShapeForm {
  kVertices,  // principal components of vertex positions
  kScape,     // of triangle deformations (SCAPE), integrated to vertices
};

struct ShapeSpaceSettings {
  ShapeForm form = ShapeForm::kVertices;
  int components = 40;

  void Describe(Fields& fields);
};

inline constexpr int kAttributeCount = 3;  // height (m), weight (kg), sex (0 female, 1 male)
Eigen::Vector3d AttributeVector(const BodyAttributes& attributes);
inline int SexIndex(Sex sex) { return sex == Sex::kMale ? 1 : 0; }

struct ShapeSpace {
  BodyModel reference;              // topology and weights; its vertices are one subject's
  Eigen::VectorXf mean;             // 3V, metres, centred
  Eigen::MatrixXf basis;            // 3V × K, metres per standard deviation
  Eigen::VectorXd joint_mean;       // 6 × 17: joints, then tips, relative to the vertices' mean
  Eigen::MatrixXd joint_basis;      // 102 × K, by regression
  Eigen::Vector3d place_mean;       // position of the vertices' mean in the subject frame, metres
  Eigen::MatrixXd place_basis;      // 3 × K, by regression
  Eigen::Vector3d attribute_mean;   // see AttributeVector
  Eigen::MatrixXd attribute_basis;  // 3 × K, by regression: the attributes' directions
  Eigen::Vector2d density_kg_m3;    // of women and men: the database's weights over its volumes

  int components() const { return static_cast<int>(basis.cols()); }
};

// The space of the given subjects of a database (indices). DataError if there are fewer than two
// subjects or too few for the components.
ShapeSpace LearnShapeSpace(const BodyDatabase& database, const std::vector<int>& subjects,
                           const ShapeSpaceSettings& settings);

// The surface of coefficients θ (up to K of them), centred.
std::vector<Vector3f> Shape(const ShapeSpace& space, const Eigen::VectorXd& theta);

// The body of coefficients θ: its surface with the feet on y = 0 and z as for the database's people
// in their subject frames, regressed joints, and the attributes measured on its surface (weight
// from the sex's density).
BodyModel PlacedBody(const ShapeSpace& space, const Eigen::VectorXd& theta, Sex sex);

// Error of the first k components on held-out people, with each subject's least-squares
// coefficients.
struct HeldOutError {
  int components = 0;
  double mean_m = 0.0;  // over vertices and subjects
  double p95_m = 0.0;
  double max_m = 0.0;
};
std::vector<HeldOutError> HeldOutErrors(const ShapeSpace& space, const BodyDatabase& database,
                                        const std::vector<int>& subjects,
                                        const std::vector<int>& component_counts);

// On disk, a folder: space.json (number of components), one .bin for each matrix above (mean and
// basis float32, the others float64, column-major, little-endian), reference/ (a body).
void WriteShapeSpace(const std::filesystem::path& folder, const ShapeSpace& space);
ShapeSpace ReadShapeSpace(const std::filesystem::path& folder);

}  // namespace vitruvia
