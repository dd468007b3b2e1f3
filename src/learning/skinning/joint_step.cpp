#include "learning/skinning/joint_step.h"

#include <array>
#include <atomic>

#include <Eigen/LU>

namespace vitruvia::skinning {
namespace {

constexpr int kVertexChunks = 16;  // of vertices; sums are kept per chunk and added in their order
constexpr int kPosesPerRange = 8, kBonesPerRange = 8;  // that a thread takes at a time
constexpr int kMostFree = kMaxInfluences - 1;

// Weights with a smaller relative effect on the vertices' places are treated as unable to
// compensate a change.
constexpr double kLeastEffect = 1e-9;
// The steps are good enough when their residual has fallen by that much.
constexpr double kTolerance = 1e-3;

int ChunkBegin(int count, int chunk) {
  return static_cast<int>(static_cast<std::int64_t>(count) * chunk / kVertexChunks);
}

}  // namespace

// A vertex of n influences: its n − 1 free weights are those of bones 1 … n − 1, bone 0's falls as
// they rise.
struct JointStep::VertexTerms {
  int size = 0;  // n
  std::array<int, kMaxInfluences> bones;
  std::array<double, kMaxInfluences> weights;
  Eigen::Vector4d point;
  Eigen::Matrix<double, kMostFree, kMostFree> inverse;  // of AᵀA

  void SetUpInverse(const Eigen::MatrixXd& products);
  void AddUndone(const Eigen::MatrixXd& products, Eigen::MatrixXd& undone) const;
};

struct JointStep::Chunk {
  Eigen::MatrixXd undone;
};

JointStep::JointStep(const PackedExamples& examples, int bones, int iterations, WorkerTeam& team)
    : examples_(examples),
      bones_(bones),
      iterations_(iterations),
      team_(team),
      equations_(examples.pose_count()),
      chunks_(kVertexChunks, Chunk{Eigen::MatrixXd(4 * bones, 4 * bones)}),
      products_(4 * bones, 4 * bones),
      undone_(4 * bones, 4 * bones),
      change_(4 * bones, 3 * examples.pose_count()),
      pull_(4 * bones, 3 * examples.pose_count()) {
  terms_.reserve(examples.vertex_count());
  for (Steps* steps :
       {&diagonal_, &solution_, &residual_, &preconditioned_, &direction_, &product_})
    steps->resize(6 * bones, examples.pose_count());
}

JointStep::~JointStep() = default;

void JointStep::SetUpTerms(const RowWeights& weights, const BoneStack& stack) {
  products_.noalias() = stack * stack.transpose();
  terms_.clear();
  for (int row = 0; row < examples_.vertex_count(); ++row) {
    if (!(weights.weights[row][1] > 0.0f)) continue;
    VertexTerms& term = terms_.emplace_back();
    term.point = examples_.Rest(row).cast<double>();
    for (; term.size < kMaxInfluences && weights.weights[row][term.size] > 0.0f; ++term.size) {
      term.bones[term.size] = weights.bones[row][term.size];
      term.weights[term.size] = weights.weights[row][term.size];
    }
    term.SetUpInverse(products_);
  }
}

// products: of the stack with itself.
void JointStep::VertexTerms::SetUpInverse(const Eigen::MatrixXd& products) {
  Eigen::Matrix4d gram;
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) {
      gram(a, b) = point.dot(products.block<4, 4>(4 * bones[a], 4 * bones[b]) * point);
    }
  }
  Eigen::Matrix3d effect = Eigen::Matrix3d::Identity();
  for (int a = 0; a + 1 < size; ++a) {
    for (int b = 0; b + 1 < size; ++b) {
      effect(a, b) = gram(a + 1, b + 1) - gram(a + 1, 0) - gram(0, b + 1) + gram(0, 0);
    }
    effect(a, a) += kLeastEffect * gram(0, 0);
  }
  inverse = effect.inverse();
}

bool JointStep::Prepare(const BonePattern& pattern, const SkinMoments& moments,
                        const RowWeights& weights, const BoneStack& stack, double damping) {
  SetUpTerms(weights, stack);
  std::atomic<bool> good = true;
  team_.For(PoseCount(stack), kPosesPerRange, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      equations_[p].Linearise(pattern, moments.second, stack.middleCols<3>(3 * p));
      equations_[p].Diagonal(pattern, diagonal_.col(p));
      if (!equations_[p].Factor(pattern, damping)) good = false;
      Adjoint(stack.middleCols<3>(3 * p), moments.cross.middleCols<3>(3 * p), residual_.col(p));
    }
  });
  return good;
}

// undone += Σ_ab w_b amount_a ṽ ṽᵀ: of the places' change, the part that weights undo, as seen by
// the bones b through u_i.
void JointStep::VertexTerms::AddUndone(const Eigen::MatrixXd& products,
                                       Eigen::MatrixXd& undone) const {
  // How far each bone's place goes along with the change, summed over poses.
  Eigen::Vector4d along = Eigen::Vector4d::Zero();
  for (int a = 0; a < size; ++a) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (int b = 0; b < size; ++b) {
      sum += weights[b] * (products.block<4, 4>(4 * bones[a], 4 * bones[b]) * point);
    }
    along[a] = point.dot(sum);
  }
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int a = 1; a < size; ++a) gradient[a - 1] = along[a] - along[0];
  const Eigen::Vector3d shares = inverse * gradient;
  Eigen::Vector4d amounts = Eigen::Vector4d::Zero();
  for (int a = 1; a < size; ++a) {
    amounts[a] = shares[a - 1];
    amounts[0] -= shares[a - 1];
  }
  const Eigen::Matrix4d outer = point * point.transpose();
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) {
      undone.block<4, 4>(4 * bones[b], 4 * bones[a]) += (weights[b] * amounts[a]) * outer;
    }
  }
}

// undone_ from change_.
void JointStep::GatherUndone(const BoneStack& stack) {
  team_.For(bones_, kBonesPerRange, [&](int begin, int end) {
    products_.middleRows(4 * begin, 4 * (end - begin)).noalias() =
        stack.middleRows(4 * begin, 4 * (end - begin)) * change_.transpose();
  });
  team_.For(kVertexChunks, 1, [&](int begin, int end) {
    for (int chunk = begin; chunk < end; ++chunk) {
      chunks_[chunk].undone.setZero();
      const int count = static_cast<int>(terms_.size());
      for (int i = ChunkBegin(count, chunk); i < ChunkBegin(count, chunk + 1); ++i) {
        terms_[i].AddUndone(products_, chunks_[chunk].undone);
      }
    }
  });
  undone_.setZero();
  for (const Chunk& chunk : chunks_) undone_ += chunk.undone;
}

void JointStep::Multiply(const SkinMoments& moments, const BoneStack& stack, double damping,
                         const Steps& steps) {
  const int poses = PoseCount(stack);
  team_.For(poses, kPosesPerRange, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      Differential(stack.middleCols<3>(3 * p), steps.col(p), change_.middleCols<3>(3 * p));
    }
  });
  GatherUndone(stack);
  team_.For(poses, kPosesPerRange, [&](int begin, int end) {
    auto pull = pull_.middleCols(3 * begin, 3 * (end - begin));
    pull.noalias() = moments.second * change_.middleCols(3 * begin, 3 * (end - begin));
    pull.noalias() -= undone_ * stack.middleCols(3 * begin, 3 * (end - begin));
    for (int p = begin; p < end; ++p) {
      Adjoint(stack.middleCols<3>(3 * p), pull_.middleCols<3>(3 * p), product_.col(p));
      product_.col(p) += damping * diagonal_.col(p).cwiseProduct(steps.col(p));
    }
  });
}

void JointStep::Precondition(const BonePattern& pattern) {
  preconditioned_ = residual_;
  team_.For(static_cast<int>(residual_.cols()), kPosesPerRange, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) equations_[p].SolveInPlace(pattern, preconditioned_.col(p));
  });
}

void JointStep::Solve(const BonePattern& pattern, const SkinMoments& moments,
                      const RowWeights& weights, const BoneStack& stack, double damping,
                      BoneStack& next) {
  next = stack;
  if (!Prepare(pattern, moments, weights, stack, damping)) return;
  solution_.setZero();
  Precondition(pattern);
  direction_ = preconditioned_;
  double error = residual_.cwiseProduct(preconditioned_).sum();
  const double good_error = kTolerance * kTolerance * error;
  for (int i = 0; i < iterations_ && error > good_error; ++i) {
    Multiply(moments, stack, damping, direction_);
    const double curvature = direction_.cwiseProduct(product_).sum();
    if (!(curvature > 0.0)) break;
    const double length = error / curvature;
    solution_ += length * direction_;
    residual_ -= length * product_;
    Precondition(pattern);
    const double next_error = residual_.cwiseProduct(preconditioned_).sum();
    direction_ = preconditioned_ + (next_error / error) * direction_;
    error = next_error;
  }
  for (int p = 0; p < PoseCount(stack); ++p) {
    Move(stack.middleCols<3>(3 * p), solution_.col(p), next.middleCols<3>(3 * p));
  }
}

}  // namespace vitruvia::skinning
