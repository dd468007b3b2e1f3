#include "learning/shape/shape_space.h"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "core/error.h"
#include "learning/shape/scape_mesh.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

constexpr int kJointCoordinates = 6 * kBoneCount;

Eigen::VectorXf Centred(const std::vector<Vector3f>& vertices, Vector3d& mean) {
  mean.setZero();
  for (const Vector3f& v : vertices) mean += v.cast<double>();
  mean /= static_cast<double>(vertices.size());
  Eigen::VectorXf flat(static_cast<Eigen::Index>(3 * vertices.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    flat.segment<3>(static_cast<Eigen::Index>(3 * v)) =
        (vertices[v].cast<double>() - mean).cast<float>();
  }
  return flat;
}

Eigen::VectorXd FlatJoints(const Skeleton& skeleton, const Vector3d& origin) {
  Eigen::VectorXd flat(kJointCoordinates);
  for (int b = 0; b < kBoneCount; ++b) {
    flat.segment<3>(3 * b) = skeleton.joints[b] - origin;
    flat.segment<3>(3 * (kBoneCount + b)) = skeleton.tips[b] - origin;
  }
  return flat;
}

// Principal components of columns: mean, D × K directions per standard deviation, and the columns'
// coefficients (N × K, uncorrelated, of unit variance).
struct Components {
  Eigen::VectorXf mean;
  Eigen::MatrixXf basis;
  Eigen::MatrixXd scores;
};

// By the eigenvectors of the N × N matrix of inner products, since people are far fewer than
// coordinates. Takes the data over, to centre them in place.
Components PrincipalComponents(Eigen::MatrixXf data, int count) {
  Components components;
  const auto n = static_cast<double>(data.cols());
  components.mean = (data.cast<double>().rowwise().sum() / n).cast<float>();
  data.colwise() -= components.mean;
  constexpr Eigen::Index kRows = 8192;  // at a time, in double: the sums of squares need it
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(data.cols(), data.cols());
  for (Eigen::Index row = 0; row < data.rows(); row += kRows) {
    const Eigen::MatrixXd block =
        data.middleRows(row, std::min(kRows, data.rows() - row)).cast<double>();
    products.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(products);  // reads the lower part
  components.scores.resize(data.cols(), count);
  Eigen::MatrixXf weights(data.cols(), count);
  for (int k = 0; k < count; ++k) {
    const Eigen::Index column = data.cols() - 1 - k;  // eigenvalues ascend
    const Eigen::VectorXd direction = eigen.eigenvectors().col(column);
    components.scores.col(k) = direction * std::sqrt(n - 1.0);
    weights.col(k) = (direction / std::sqrt(n - 1.0)).cast<float>();
  }
  components.basis = data * weights;
  return components;
}

Components VertexComponents(const BodyDatabase& database, const std::vector<int>& subjects,
                            int count) {
  const auto rows = static_cast<Eigen::Index>(3 * database.reference.rest.vertices.size());
  Eigen::MatrixXf data(rows, static_cast<Eigen::Index>(subjects.size()));
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    Vector3d mean;
    data.col(static_cast<Eigen::Index>(i)) =
        Centred(database.subjects[static_cast<std::size_t>(subjects[i])].vertices, mean);
  }
  return PrincipalComponents(std::move(data), count);
}

Components ScapeComponents(const BodyDatabase& database, const std::vector<int>& subjects,
                           int count) {
  const ScapeMesh mesh(database.reference.rest);
  Eigen::MatrixXf data(static_cast<Eigen::Index>(9 * mesh.triangle_count()),
                       static_cast<Eigen::Index>(subjects.size()));
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    data.col(static_cast<Eigen::Index>(i)) =
        mesh.Deformations(database.subjects[static_cast<std::size_t>(subjects[i])].vertices);
  }
  Components components = PrincipalComponents(std::move(data), count);
  components.mean = mesh.Integrate(components.mean).cast<float>();
  components.basis = mesh.Integrate(components.basis).cast<float>();
  return components;
}

// Scores are uncorrelated and of unit variance, so least squares is a product.
Eigen::MatrixXd Regression(const Eigen::MatrixXd& values, const Eigen::MatrixXd& scores) {
  const Eigen::VectorXd mean = values.rowwise().mean();
  return (values.colwise() - mean) * scores / static_cast<double>(scores.rows() - 1);
}

// Weight over volume of all people of each sex; of a sex without people, that of the other.
Eigen::Vector2d Densities(const BodyDatabase& database, const std::vector<int>& subjects) {
  Eigen::Vector2d weight_kg = Eigen::Vector2d::Zero(), volume_m3 = Eigen::Vector2d::Zero();
  for (const int s : subjects) {
    const DatabaseSubject& subject = database.subjects[static_cast<std::size_t>(s)];
    const int sex = SexIndex(subject.attributes.sex);
    weight_kg[sex] += subject.attributes.weight_kg;
    volume_m3[sex] += EnclosedVolume({subject.vertices, database.reference.rest.triangles});
  }
  for (int sex = 0; sex < 2; ++sex) {
    if (volume_m3[sex] > 0.0) continue;
    weight_kg[sex] = weight_kg[1 - sex];
    volume_m3[sex] = volume_m3[1 - sex];
  }
  return weight_kg.cwiseQuotient(volume_m3);
}

}  // namespace

void ShapeSpaceSettings::Describe(Fields& f) {
  f.Choice("form", form, {{"vertices", ShapeForm::kVertices}, {"scape", ShapeForm::kScape}},
           {.meaning = "what the principal components are of: vertex positions, or triangle "
                       "deformations (SCAPE)",
            .origin = Origin::kTuned,
            .source = "paper A, sec. 4 has SCAPE's; vertices reconstruct held-out people better"});
  f.Integer("components", components,
            {.meaning = "principal components kept",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "paper A names no number"});
}

Eigen::Vector3d AttributeVector(const BodyAttributes& attributes) {
  return {attributes.height_m, attributes.weight_kg, attributes.sex == Sex::kMale ? 1.0 : 0.0};
}

ShapeSpace LearnShapeSpace(const BodyDatabase& database, const std::vector<int>& subjects,
                           const ShapeSpaceSettings& settings) {
  const auto people = static_cast<Eigen::Index>(subjects.size());
  if (people <= settings.components) {
    throw DataError(fmt::format(
        "shape space: {} people, expected more than the {} components that are to be learnt",
        people, settings.components));
  }
  Eigen::MatrixXd joints(kJointCoordinates, people), attributes(kAttributeCount, people),
      places(3, people);
  for (Eigen::Index i = 0; i < people; ++i) {
    const DatabaseSubject& subject = database.subjects[static_cast<std::size_t>(subjects[i])];
    Vector3d mean;
    Centred(subject.vertices, mean);
    joints.col(i) = FlatJoints(subject.skeleton, mean);
    places.col(i) = mean;
    attributes.col(i) = AttributeVector(subject.attributes);
  }
  const Components components = settings.form == ShapeForm::kScape
                                    ? ScapeComponents(database, subjects, settings.components)
                                    : VertexComponents(database, subjects, settings.components);
  ShapeSpace space;
  space.reference = database.reference;
  space.mean = components.mean;
  space.basis = components.basis;
  space.joint_mean = joints.rowwise().mean();
  space.joint_basis = Regression(joints, components.scores);
  space.place_mean = places.rowwise().mean();
  space.place_basis = Regression(places, components.scores);
  space.density_kg_m3 = Densities(database, subjects);
  space.attribute_mean = attributes.rowwise().mean();
  space.attribute_basis = Regression(attributes, components.scores);
  return space;
}

std::vector<Vector3f> Shape(const ShapeSpace& space, const Eigen::VectorXd& theta) {
  Require(theta.size() <= space.components(), "Shape: {} coefficients, the space has {}",
          theta.size(), space.components());
  const Eigen::VectorXf flat =
      space.mean + space.basis.leftCols(theta.size()) * theta.cast<float>();
  std::vector<Vector3f> vertices(static_cast<std::size_t>(flat.size() / 3));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertices[v] = flat.segment<3>(static_cast<Eigen::Index>(3 * v));
  }
  return vertices;
}

BodyModel PlacedBody(const ShapeSpace& space, const Eigen::VectorXd& theta, Sex sex) {
  BodyModel body = space.reference;
  body.rest.vertices = Shape(space, theta);
  const auto [lowest, highest] =
      std::minmax_element(body.rest.vertices.begin(), body.rest.vertices.end(),
                          [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); });
  body.attributes = {static_cast<double>(highest->y() - lowest->y()),
                     EnclosedVolume(body.rest) * space.density_kg_m3[SexIndex(sex)], sex};
  const Eigen::Vector3d place = space.place_mean + space.place_basis.leftCols(theta.size()) * theta;
  const Vector3f lift(static_cast<float>(place.x()), -lowest->y(), static_cast<float>(place.z()));
  for (Vector3f& v : body.rest.vertices) v += lift;
  const Eigen::VectorXd joints =
      space.joint_mean + space.joint_basis.leftCols(theta.size()) * theta;
  for (int b = 0; b < kBoneCount; ++b) {
    body.skeleton.joints[b] = joints.segment<3>(3 * b) + lift.cast<double>();
    body.skeleton.tips[b] = joints.segment<3>(3 * (kBoneCount + b)) + lift.cast<double>();
  }
  return body;
}

std::vector<HeldOutError> HeldOutErrors(const ShapeSpace& space, const BodyDatabase& database,
                                        const std::vector<int>& subjects,
                                        const std::vector<int>& component_counts) {
  std::vector<HeldOutError> errors;
  for (const int count : component_counts) {
    Require(count >= 1 && count <= space.components(), "HeldOutErrors: {} components of {}", count,
            space.components());
    const Eigen::MatrixXd basis = space.basis.leftCols(count).cast<double>();
    const Eigen::LDLT<Eigen::MatrixXd> normal(basis.transpose() * basis);
    std::vector<double> distances;
    for (const int s : subjects) {
      Vector3d mean;
      const Eigen::VectorXd wanted =
          (Centred(database.subjects[static_cast<std::size_t>(s)].vertices, mean) - space.mean)
              .cast<double>();
      const Eigen::VectorXd theta = normal.solve(basis.transpose() * wanted);
      const Eigen::VectorXd left = wanted - basis * theta;
      for (Eigen::Index v = 0; v < left.size(); v += 3)
        distances.push_back(left.segment<3>(v).norm());
    }
    errors.push_back({count, Mean(distances), Quantile(distances, 0.95), Maximum(distances)});
  }
  return errors;
}

}  // namespace vitruvia
