#include "methods/scape_regression/scape_body.h"

#include "learning/shape/scape_mesh.h"
#include "math/rigid_fit.h"
#include "math/rotation.h"
#include "math/rotation_derivatives.h"

namespace vitruvia::scape_regression {
namespace {

// The joints whose turns deform a part's triangles.
std::array<std::vector<int>, kBoneCount> JointsOfParts(const PoseRegression& regression) {
  std::array<std::array<bool, kBoneCount>, kBoneCount> looks_at{};
  for (const TrianglePoseModel& model : regression.triangles) {
    for (const int joint : model.joints) {
      if (joint >= 0) looks_at[model.bone][joint] = true;
    }
  }
  std::array<std::vector<int>, kBoneCount> joints;
  for (int part = 0; part < kBoneCount; ++part) {
    for (int joint = 0; joint < kBoneCount; ++joint) {
      if (looks_at[part][joint]) joints[part].push_back(joint);
    }
  }
  return joints;
}

// The term of a triangle's Q that goes with a joint's component; null if it has none.
const Matrix3<float>* TermOf(const TrianglePoseModel& model, int joint, int component) {
  if (joint < 0) return &model.terms[0];
  for (int c = 0; c < kRegressionJoints; ++c) {
    if (model.joints[c] == joint) return &model.terms[1 + 3 * c + component];
  }
  return nullptr;
}

}  // namespace

ScapeBody::ScapeBody(const BodyModel& subject, const PoseRegression& regression)
    : rest_(subject.rest.vertices),
      triangles_(subject.rest.triangles),
      skeleton_(subject.skeleton) {
  for (const Vector3f& v : rest_) rest_center_ += v.cast<double>();
  rest_center_ /= static_cast<double>(rest_.size());
  for (std::size_t v = 0; v < rest_.size(); ++v)
    vertices_of_part_[subject.weights.bones[v][0]].push_back(static_cast<int>(v));

  const auto joints = JointsOfParts(regression);
  for (int part = 0; part < kBoneCount; ++part) {
    infos_.push_back({part, -1, 0});
    for (const int joint : joints[part]) {
      for (int component = 0; component < 3; ++component)
        infos_.push_back({part, joint, component});
    }
  }
  const ScapeMesh mesh(subject.rest);
  fields_.resize(rest_.size() * infos_.size());
  Eigen::VectorXf deformations(static_cast<Eigen::Index>(9 * triangles_.size()));
  for (std::size_t f = 0; f < infos_.size(); ++f) {
    deformations.setZero();
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      const TrianglePoseModel& model = regression.triangles[k];
      if (model.bone != infos_[f].part) continue;
      const Matrix3<float>* term = TermOf(model, infos_[f].joint, infos_[f].component);
      if (term == nullptr) continue;
      Eigen::Map<Matrix3<float>>(&deformations(static_cast<Eigen::Index>(9 * k))) = *term;
    }
    const Eigen::MatrixXd field = mesh.Integrate(deformations);
    for (std::size_t v = 0; v < rest_.size(); ++v) {
      fields_[v * infos_.size() + f] =
          field.block<3, 1>(static_cast<Eigen::Index>(3 * v), 0).cast<float>();
    }
  }
}

void ScapeBody::Vertices(const ScapePose& pose, std::vector<Vector3f>& vertices) const {
  const auto turns = JointRotationVectors(pose.rotations);
  std::array<Matrix3<float>, kBoneCount> rotations;
  for (int b = 0; b < kBoneCount; ++b) rotations[b] = pose.rotations[b].cast<float>();
  std::vector<float> factors;
  for (const FieldInfo& info : infos_) {
    factors.push_back(info.joint < 0 ? 1.0f
                                     : static_cast<float>(turns[info.joint][info.component]));
  }
  const Vector3f center = pose.center.cast<float>();
  vertices.resize(rest_.size());
  const Vector3f* field = fields_.data();
  for (Vector3f& vertex : vertices) {
    vertex = center;
    std::size_t f = 0;
    while (f < infos_.size()) {
      const int part = infos_[f].part;
      Vector3f in_part = Vector3f::Zero();
      for (; f < infos_.size() && infos_[f].part == part; ++f) in_part += factors[f] * field[f];
      vertex += rotations[part] * in_part;
    }
    field += infos_.size();
  }
}

ScapeBody::Linearization ScapeBody::LinearizeAt(const ScapePose& pose) {
  Linearization at{pose.rotations, JointRotationVectors(pose.rotations), {}};
  for (int b = 0; b < kBoneCount; ++b)
    at.turn_by_own[b] = InverseRightJacobian(at.turns[b]) * pose.rotations[b].transpose();
  return at;
}

ScapeBody::Row ScapeBody::RowOf(const Linearization& at, int vertex, const Vector3d& n) const {
  Row row;
  row.setZero();
  row.head<3>() = n.transpose();
  std::array<Vector3d, kBoneCount> by_turn;  // d(n · v) / dΔr
  by_turn.fill(Vector3d::Zero());
  std::size_t f = 0;
  while (f < infos_.size()) {
    const int part = infos_[f].part;
    const Vector3d n_in_part = at.rotations[part].transpose() * n;
    Vector3d in_part = Vector3d::Zero();
    for (; f < infos_.size() && infos_[f].part == part; ++f) {
      const FieldInfo& info = infos_[f];
      const Vector3d field = Field(vertex, f);
      if (info.joint < 0) {
        in_part += field;
      } else {
        in_part += at.turns[info.joint][info.component] * field;
        by_turn[info.joint][info.component] += n_in_part.dot(field);
      }
    }
    row.segment<3>(3 + 3 * part) += (at.rotations[part] * in_part).cross(n).transpose();
  }
  for (int b = 1; b < kBoneCount; ++b) {
    const Eigen::RowVector3d by_rotation = by_turn[b].transpose() * at.turn_by_own[b];
    row.segment<3>(3 + 3 * b) += by_rotation;
    row.segment<3>(3 + 3 * Bones()[b].parent) -= by_rotation;
  }
  return row;
}

ScapePose ScapeBody::Stepped(const ScapePose& pose, const Eigen::VectorXd& step) {
  ScapePose stepped = pose;
  stepped.center += step.head<3>();
  for (int b = 0; b < kBoneCount; ++b)
    stepped.rotations[b] = ExpSo3<double>(step.segment<3>(3 + 3 * b)) * pose.rotations[b];
  return stepped;
}

ScapePose ScapeBody::RestPose(const Rigidd& camera_from_subject) const {
  ScapePose pose;
  pose.rotations.fill(camera_from_subject.rotation);
  pose.center = camera_from_subject * rest_center_;
  return pose;
}

// The mean follows from the pelvis: the surface is placed so that its pelvis part matches.
ScapePose ScapeBody::PoseOf(const BoneTransforms& camera_from_rest) const {
  ScapePose pose;
  for (int b = 0; b < kBoneCount; ++b) pose.rotations[b] = camera_from_rest[b].rotation;
  std::vector<Vector3f> vertices;
  Vertices(pose, vertices);
  Vector3d off = Vector3d::Zero();
  for (const int v : vertices_of_part_[0])
    off += camera_from_rest[0] * rest_[v].cast<double>() - vertices[v].cast<double>();
  if (!vertices_of_part_[0].empty())
    pose.center = off / static_cast<double>(vertices_of_part_[0].size());
  return pose;
}

BoneTransforms ScapeBody::PartMotions(const std::vector<Vector3f>& vertices) const {
  BoneTransforms motions(kBoneCount);
  for (int b = 0; b < kBoneCount; ++b) {
    const std::vector<int>& part = vertices_of_part_[b];
    if (part.size() < 3) {
      const int parent = Bones()[b].parent;
      if (parent >= 0) motions[b] = motions[parent];
      continue;
    }
    motions[b] = FitRigid(part.size(), [&](std::size_t i) {
      return PointPair{rest_[part[i]].cast<double>(), vertices[part[i]].cast<double>()};
    });
  }
  return motions;
}

std::vector<Vector3d> ScapeBody::Joints(const BoneTransforms& part_motions) const {
  std::vector<Vector3d> joints;
  for (int b = 0; b < kBoneCount; ++b) {
    const int parent = Bones()[b].parent;
    const Vector3d own = part_motions[b] * skeleton_.joints[b];
    joints.push_back(
        parent < 0 ? own : Vector3d(0.5 * (own + part_motions[parent] * skeleton_.joints[b])));
  }
  return joints;
}

}  // namespace vitruvia::scape_regression
