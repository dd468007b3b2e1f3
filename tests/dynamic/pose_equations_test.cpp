// The normal equations, assembled per link and reduced to the joints, against the direct Jacobian
// per joint as the paper writes it and against automatic differentiation.
#include "methods/dynamic/pose_equations.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "dynamic_fixtures.h"
#include "math/rigid.h"

namespace vitruvia::dynamic {
namespace {

constexpr int kMaxJoints = 64;
using Jet = ceres::Jet<double, kMaxJoints>;

// Observed points near the vertices; every third vertex has none.
Observations<double> SomeObservations(const Surface<double>& surface) {
  RandomStream random(4, "observations");
  Observations<double> observations;
  observations.Reset(surface.layout.slot_count());
  for (int slot = 0; slot < surface.layout.slot_count(); ++slot) {
    const int vertex = surface.layout.vertex_of_slot[slot];
    if (vertex < 0 || vertex % 3 == 0) continue;
    for (int i = 0; i <= vertex % 2; ++i) {
      observations.Add(slot, surface.posed.At(slot) + Vector3d(random.Uniform(-0.02, 0.02),
                                                               random.Uniform(-0.02, 0.02),
                                                               random.Uniform(-0.02, 0.02)));
    }
  }
  return observations;
}

struct EquationStage {
  EquationStage(double range_rad, std::uint64_t seed, double moved_away_m = 0.0)
      : body(BlendedBody()),
        tree(HumanSkeleton(), body.skeleton),
        surface(SurfaceOf<double>(SmoothMesh(body))),
        theta(RandomTheta(tree, range_rad, seed)) {
    Rigidd camera_from_start = CameraFromStart();
    camera_from_start.translation.z() += moved_away_m;
    tree.Pose(camera_from_start, theta, pose);
    PoseAll(pose, surface);
    observations = SomeObservations(surface);
  }

  PoseEquations Assembled() const {
    LinkEquations<double> links(surface.layout);
    const auto motions = LinkMotionsOf<double>(pose);
    for (std::size_t i = 0; i < surface.layout.patches.size(); ++i) {
      links.AddPatch(static_cast<int>(i), surface, motions, observations);
    }
    PoseEquations equations;
    links.ReduceToJoints(surface.layout, tree, pose, equations);
    return equations;
  }

  // Sums JᵀJ, Jᵀr and r² of rows that `row_of` gives for each observed slot.
  template <class RowOf>
  PoseEquations Summed(const RowOf& row_of) const {
    PoseEquations sum;
    sum.hessian.setZero(tree.joint_count(), tree.joint_count());
    sum.gradient.setZero(tree.joint_count());
    for (const Patch& patch : surface.layout.patches) {
      for (int slot = patch.begin; slot < patch.end; ++slot) {
        if (observations.Count(slot) == 0.0) continue;
        const auto [row, r] = row_of(patch, slot);
        sum.hessian += row * row.transpose();
        sum.gradient += row * r;
        sum.energy += r * r;
        ++sum.residuals;
      }
    }
    return sum;
  }

  BodyModel body;
  KinematicTree tree;
  Surface<double> surface;
  Eigen::VectorXd theta;
  TreePose pose;
  Observations<double> observations;
};

void ExpectSame(const PoseEquations& a, const PoseEquations& b, double relative) {
  EXPECT_EQ(a.residuals, b.residuals);
  EXPECT_GT(a.residuals, 500);
  EXPECT_NEAR(a.energy, b.energy, relative * b.energy);
  EXPECT_LT((a.hessian - b.hessian).norm(), relative * b.hessian.norm());
  EXPECT_LT((a.gradient - b.gradient).norm(), relative * b.gradient.norm());
  EXPECT_GT(b.gradient.norm(), 0.1);
}

// ---- The paper's chain: ∂v/∂b (3 × 8), w_k I, ∂T_k/∂θ_m ----

using Vector8 = Eigen::Matrix<double, 8, 1>;

Vector8 Flat(const DualQuaternion<double>& q) {
  Vector8 flat;
  flat << q.real.coeffs(), q.dual.coeffs();  // x y z w, x y z w
  return flat;
}

// b(v̄) = (q_r v̄ q_r* + 2 vec(q_d q_r*)) / |q_r|², differentiated coefficient by coefficient.
Eigen::Matrix<double, 3, 8> PointByBlend(const Vector8& b, const Vector3d& rest) {
  const Eigen::Quaterniond real(b[3], b[0], b[1], b[2]), dual(b[7], b[4], b[5], b[6]);
  const Eigen::Quaterniond point(0.0, rest.x(), rest.y(), rest.z());
  const auto value = [&](const Eigen::Quaterniond& left,
                         const Eigen::Quaterniond& right) -> Vector3d {
    return (left * point * right.conjugate()).vec();
  };
  const double n2 = real.squaredNorm();
  const Vector3d v = (value(real, real) + 2.0 * (dual * real.conjugate()).vec()) / n2;
  Eigen::Matrix<double, 3, 8> jacobian;
  for (int i = 0; i < 4; ++i) {
    Eigen::Quaterniond unit(0.0, 0.0, 0.0, 0.0);
    unit.coeffs()[i] = 1.0;
    jacobian.col(i) = (value(unit, real) + value(real, unit) +
                       2.0 * (dual * unit.conjugate()).vec() - 2.0 * b[i] * v) /
                      n2;
    jacobian.col(4 + i) = 2.0 * (unit * real.conjugate()).vec() / n2;
  }
  return jacobian;
}

// ∂T_k/∂θ_m T_k(0)⁻¹ by central differences would not reach 1e-9; by the paper's own J' instead:
// T_parent(m) O_m J'_m J_m⁻¹ (T_parent(m) O_m)⁻¹ is half of the joint's twist as a dual quaternion.
DualQuaternion<double> Derivative(const Twist& twist, const Vector3d& twist_origin,
                                  const DualQuaternion<double>& bone) {
  DualQuaternion<double> half_twist = DualQuaternion<double>::Zero();
  const Vector3d angular = twist.head<3>();
  half_twist.real.vec() = 0.5 * angular;
  half_twist.dual.vec() = 0.5 * (twist.tail<3>() + twist_origin.cross(angular));
  return Product(half_twist, bone);
}

TEST(PoseEquations, AreThoseOfTheDirectJacobianPerJoint) {
  const EquationStage stage(1.0, 21);
  const auto row_of = [&](const Patch& patch, int slot) {
    const Surface<double>& s = stage.surface;
    Vector8 blend = Vector8::Zero();
    std::array<double, kMaxInfluences> signs{};
    for (int k = 0; k < patch.influences; ++k) {
      const auto& q = stage.pose.camera_from_rest[patch.bones[k]];
      signs[k] = q.real.dot(stage.pose.camera_from_rest[patch.bones[0]].real) < 0.0 ? -1.0 : 1.0;
      blend += signs[k] * s.weights[k][slot] * Flat(q);
    }
    const auto by_blend = PointByBlend(blend, s.rest.At(slot));
    const Vector3d normal = s.normals.At(slot);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(stage.tree.joint_count());
    for (int k = 0; k < patch.influences; ++k) {
      for (const int joint : stage.tree.ChainOf(patch.bones[k])) {
        const auto change = Derivative(stage.pose.twists[joint], stage.pose.twist_origin,
                                       stage.pose.camera_from_rest[patch.bones[k]]);
        row[joint] += normal.dot(by_blend * (signs[k] * s.weights[k][slot] * Flat(change)));
      }
    }
    return std::pair(row, normal.dot(s.posed.At(slot) - stage.observations.Mean(slot)));
  };
  ExpectSame(stage.Assembled(), stage.Summed(row_of), 1e-9);
}

// ---- Ceres Jets through the whole chain, written once more ----

struct JetDualQuaternion {
  Eigen::Quaternion<Jet> real, dual;
};

Eigen::Quaternion<Jet> Sum(const Eigen::Quaternion<Jet>& a, const Eigen::Quaternion<Jet>& b) {
  return {a.w() + b.w(), a.x() + b.x(), a.y() + b.y(), a.z() + b.z()};
}

Eigen::Quaternion<Jet> Scaled(const Jet& s, const Eigen::Quaternion<Jet>& a) {
  return {s * a.w(), s * a.x(), s * a.y(), s * a.z()};
}

JetDualQuaternion Times(const JetDualQuaternion& a, const JetDualQuaternion& b) {
  return {a.real * b.real, Sum(a.real * b.dual, a.dual * b.real)};
}

JetDualQuaternion Constant(const Rigidd& rigid) {
  const auto q = DualQuaternion<double>::FromRigid(rigid);
  return {q.real.cast<Jet>(), q.dual.cast<Jet>()};
}

JetDualQuaternion JointMotion(const TreeJoint& joint, const Jet& value) {
  const Jet zero(0.0), one(1.0), half = Jet(0.5) * value;
  const Vector3d& a = joint.axis;
  if (joint.type == JointType::kPrismatic) {
    return {{one, zero, zero, zero}, {zero, half * a.x(), half * a.y(), half * a.z()}};
  }
  const Jet s = sin(half);
  return {{cos(half), s * a.x(), s * a.y(), s * a.z()}, {zero, zero, zero, zero}};
}

TEST(PoseEquations, AreThoseOfAutomaticDifferentiation) {
  const EquationStage stage(1.3, 22);
  const KinematicTree& tree = stage.tree;
  ASSERT_LE(tree.joint_count(), kMaxJoints);
  std::vector<JetDualQuaternion> links;
  for (int k = 0; k < tree.joint_count(); ++k) {
    const TreeJoint& joint = tree.joints()[k];
    const JetDualQuaternion parent =
        joint.parent < 0 ? Constant(CameraFromStart()) : links[joint.parent];
    const Vector3d from =
        joint.parent < 0 ? Vector3d(Vector3d::Zero()) : tree.joints()[joint.parent].place;
    links.push_back(
        Times(Times(parent, Constant({Matrix3<double>::Identity(), joint.place - from})),
              JointMotion(joint, Jet(stage.theta[k], k))));
  }
  std::vector<JetDualQuaternion> bones;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const int link = tree.ChainOf(bone).back();
    bones.push_back(
        Times(links[link], Constant({Matrix3<double>::Identity(), -tree.joints()[link].place})));
  }
  const auto row_of = [&](const Patch& patch, int slot) {
    const Surface<double>& s = stage.surface;
    const Jet zero(0.0);
    JetDualQuaternion blend{{zero, zero, zero, zero}, {zero, zero, zero, zero}};
    for (int k = 0; k < patch.influences; ++k) {
      const JetDualQuaternion& q = bones[patch.bones[k]];
      const bool apart = q.real.dot(bones[patch.bones[0]].real).a < 0.0;
      const Jet w(apart ? -s.weights[k][slot] : s.weights[k][slot]);
      blend = {Sum(blend.real, Scaled(w, q.real)), Sum(blend.dual, Scaled(w, q.dual))};
    }
    const Jet scale = Jet(1.0) / blend.real.norm();
    const Eigen::Quaternion<Jet> real = Scaled(scale, blend.real), dual = Scaled(scale, blend.dual);
    const Vector3d rest = s.rest.At(slot);
    const Eigen::Quaternion<Jet> point(zero, Jet(rest.x()), Jet(rest.y()), Jet(rest.z()));
    const Eigen::Quaternion<Jet> turned = real * point * real.conjugate();
    const Eigen::Quaternion<Jet> moved = dual * real.conjugate();
    const Vector3d normal = s.normals.At(slot), mean = stage.observations.Mean(slot);
    Jet r = zero;
    for (int i = 0; i < 3; ++i) {
      r += normal[i] * (turned.vec()[i] + 2.0 * moved.vec()[i] - mean[i]);
    }
    return std::pair(Eigen::VectorXd(r.v.head(tree.joint_count())), r.a);
  };
  ExpectSame(stage.Assembled(), stage.Summed(row_of), 1e-9);
}

PoseEquations AssembledInFloat(const EquationStage& stage) {
  auto surface = SurfaceOf<float>(SmoothMesh(stage.body));
  PoseAll(stage.pose, surface);
  Observations<float> observations;
  observations.observed = stage.observations.observed;
  for (const double sum : stage.observations.sums)
    observations.sums.push_back(static_cast<float>(sum));
  LinkEquations<float> links(surface.layout);
  const auto motions = LinkMotionsOf<float>(stage.pose);
  for (std::size_t i = 0; i < surface.layout.patches.size(); ++i) {
    links.AddPatch(static_cast<int>(i), surface, motions, observations);
  }
  PoseEquations equations;
  links.ReduceToJoints(surface.layout, stage.tree, stage.pose, equations);
  return equations;
}

// The largest |H_ij − H'_ij| / √(H_ii H_jj): the error of an entry on the scale of its joints.
double LargestEntryError(const PoseEquations& equations, const PoseEquations& reference) {
  const Eigen::VectorXd scale = reference.hessian.diagonal().cwiseSqrt();
  double largest = 0.0;
  for (int i = 0; i < scale.size(); ++i) {
    for (int j = 0; j < scale.size(); ++j) {
      const double error = std::abs(equations.hessian(i, j) - reference.hessian(i, j));
      if (scale[i] * scale[j] > 0.0) largest = std::max(largest, error / (scale[i] * scale[j]));
    }
  }
  return largest;
}

// Twists about the camera's origin would cost joints with short levers, wrists and ankles, more
// digits with the square of the distance.
TEST(PoseEquations, InSinglePrecisionHoldForEveryJointAtAnyDistance) {
  for (const double moved_away_m : {0.0, 25.0}) {
    const EquationStage stage(0.8, 23, moved_away_m);
    const PoseEquations reference = stage.Assembled(), equations = AssembledInFloat(stage);
    EXPECT_LT(LargestEntryError(equations, reference), 1e-4) << moved_away_m << " m";
    EXPECT_LT((equations.gradient - reference.gradient).norm(),
              1e-4 * (1.0 + moved_away_m) * reference.gradient.norm());
  }
}

}  // namespace
}  // namespace vitruvia::dynamic
