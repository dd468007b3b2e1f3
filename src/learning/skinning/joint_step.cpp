#include "learning/skinning/joint_step.h"

#include <array>

#include <Eigen/Cholesky>

#include "core/parallel.h"
#include "math/rigid.h"

namespace vitruvia::skinning {
namespace {

constexpr int kChunks = 16;  // of vertices, of poses and of bones; sums are added in their order
constexpr int kMostFree = kMaxInfluences - 1;

// Weights whose effect on the places is smaller, relative to the places themselves, undo nothing.
constexpr double kLeastEffect = 1e-9;
// The steps are good enough when their residual has fallen by that much.
constexpr double kTolerance = 1e-3;

int ChunkBegin(int count, int chunk) {
  return static_cast<int>(static_cast<std::int64_t>(count) * chunk / kChunks);
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
};

struct JointStep::Chunk {
  Eigen::MatrixXd undone;
};

JointStep::JointStep(const PackedExamples& examples, int bones, int iterations, int threads)
    : examples_(examples),
      bones_(bones),
      iterations_(iterations),
      threads_(threads),
      equations_(examples.pose_count()),
      chunks_(kChunks, Chunk{Eigen::MatrixXd(4 * bones, 4 * bones)}),
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
    Eigen::Matrix4d gram;
    for (int a = 0; a < term.size; ++a) {
      for (int b = 0; b < term.size; ++b) {
        gram(a, b) = term.point.dot(products_.block<4, 4>(4 * term.bones[a], 4 * term.bones[b]) *
                                    term.point);
      }
    }
    Eigen::Matrix3d effect = Eigen::Matrix3d::Identity();
    const int free = term.size - 1;
    for (int a = 0; a < free; ++a) {
      for (int b = 0; b < free; ++b) {
        effect(a, b) = gram(a + 1, b + 1) - gram(a + 1, 0) - gram(0, b + 1) + gram(0, 0);
      }
      effect(a, a) += kLeastEffect * gram(0, 0);
    }
    term.inverse = effect.inverse();
  }
}

bool JointStep::Prepare(const BonePattern& pattern, const SkinMoments& moments,
                        const RowWeights& weights, const BoneStack& stack, double damping) {
  SetUpTerms(weights, stack);
  std::array<bool, kChunks> good;
  good.fill(true);
  const int poses = PoseCount(stack);
  ParallelFor(kChunks, threads_, [&](int begin, int end) {
    for (int chunk = begin; chunk < end; ++chunk) {
      for (int p = ChunkBegin(poses, chunk); p < ChunkBegin(poses, chunk + 1); ++p) {
        equations_[p].Linearise(pattern, moments.second, stack.middleCols<3>(3 * p));
        equations_[p].Diagonal(pattern, diagonal_.col(p));
        good[chunk] = equations_[p].Factor(pattern, damping) && good[chunk];
        Adjoint(stack.middleCols<3>(3 * p), moments.cross.middleCols<3>(3 * p), residual_.col(p));
      }
    }
  });
  return std::find(good.begin(), good.end(), false) == good.end();
}

void JointStep::Multiply(const SkinMoments& moments, const BoneStack& stack, double damping,
                         const Steps& steps) {
  const int poses = PoseCount(stack);
  ParallelFor(kChunks, threads_, [&](int begin, int end) {
    for (int p = ChunkBegin(poses, begin); p < ChunkBegin(poses, end); ++p) {
      Differential(stack.middleCols<3>(3 * p), steps.col(p), change_.middleCols<3>(3 * p));
    }
  });
  ParallelFor(kChunks, threads_, [&](int begin, int end) {
    const int first = 4 * ChunkBegin(bones_, begin), last = 4 * ChunkBegin(bones_, end);
    products_.middleRows(first, last - first).noalias() =
        stack.middleRows(first, last - first) * change_.transpose();
  });
  ParallelFor(kChunks, threads_, [&](int begin, int end) {
    for (int chunk = begin; chunk < end; ++chunk) {
      Eigen::MatrixXd& undone = chunks_[chunk].undone;
      undone.setZero();
      const int count = static_cast<int>(terms_.size());
      for (int i = ChunkBegin(count, chunk); i < ChunkBegin(count, chunk + 1); ++i) {
        const VertexTerms& term = terms_[i];
        std::array<double, kMaxInfluences> effects{};
        for (int a = 0; a < term.size; ++a) {
          Eigen::Vector4d sum = Eigen::Vector4d::Zero();
          for (int b = 0; b < term.size; ++b) {
            sum += term.weights[b] *
                   (products_.block<4, 4>(4 * term.bones[a], 4 * term.bones[b]) * term.point);
          }
          effects[a] = term.point.dot(sum);
        }
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (int a = 1; a < term.size; ++a) gradient[a - 1] = effects[a] - effects[0];
        const Eigen::Vector3d shares = term.inverse * gradient;
        Eigen::Vector4d amounts = Eigen::Vector4d::Zero();
        for (int a = 1; a < term.size; ++a) {
          amounts[a] = shares[a - 1];
          amounts[0] -= shares[a - 1];
        }
        const Eigen::Matrix4d outer = term.point * term.point.transpose();
        for (int a = 0; a < term.size; ++a) {
          for (int b = 0; b < term.size; ++b) {
            undone.block<4, 4>(4 * term.bones[b], 4 * term.bones[a]) +=
                (term.weights[b] * amounts[a]) * outer;
          }
        }
      }
    }
  });
  undone_.setZero();
  for (const Chunk& chunk : chunks_) undone_ += chunk.undone;
  ParallelFor(kChunks, threads_, [&](int begin, int end) {
    const int first = 3 * ChunkBegin(poses, begin), last = 3 * ChunkBegin(poses, end);
    auto pull = pull_.middleCols(first, last - first);
    pull.noalias() = moments.second * change_.middleCols(first, last - first);
    pull.noalias() -= undone_ * stack.middleCols(first, last - first);
    for (int p = first / 3; p < last / 3; ++p) {
      Adjoint(stack.middleCols<3>(3 * p), pull_.middleCols<3>(3 * p), product_.col(p));
      product_.col(p) += damping * diagonal_.col(p).cwiseProduct(steps.col(p));
    }
  });
}

void JointStep::Precondition(const BonePattern& pattern) {
  preconditioned_ = residual_;
  ParallelFor(static_cast<int>(residual_.cols()), threads_, [&](int begin, int end) {
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
