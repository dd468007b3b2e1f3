#include "learning/skinning/weight_step.h"

#include <algorithm>

#include "core/error.h"
#include "learning/skinning/simplex_qp.h"

// Every product of a vertex's places under two bones, summed over all poses, is a quadratic form in
// its rest point whose 4 × 4 matrix depends on the two bones alone. So a vertex's normal equations
// cost the same for 7 poses as for 700; only their right-hand side reads the examples, and that by
// way of the residual at the present weights: small numbers, for which floats do.
namespace vitruvia::skinning {
namespace {

constexpr int kRowChunks = 16;  // of rows; sums are kept per chunk and added in their order
constexpr int kMaxTerms = 4 * kMaxInfluences;

using ConstLanes = Eigen::Map<const Lanes>;
using MutableLanes = Eigen::Map<Lanes>;

// The non-zero entries of u_i (bone_stack.h).
struct Terms {
  int size = 0;
  int rows[kMaxTerms];  // of the stack
  float factors[kMaxTerms];

  Terms(const RowWeights& weights, int row, const RestPoint& rest) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      const float weight = weights.weights[row][k];
      if (!(weight > 0.0f)) continue;
      for (int c = 0; c < 4; ++c, ++size) {
        rows[size] = 4 * weights.bones[row][k] + c;
        factors[size] = weight * rest[c];
      }
    }
  }
};

}  // namespace

struct WeightStep::Chunk {
  std::vector<float, Eigen::aligned_allocator<float>> residual;  // of the row at hand
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> cross;
  Eigen::MatrixXd second;
  double energy = 0.0;

  void SetZero() {
    cross.setZero();
    second.setZero();
    energy = 0.0;
  }
};

namespace {

// residual = observed − Σ factor · stack row; returns its squared norm.
template <class Stack>
double Residual(const Stack& stack, const Terms& terms, const float* observed, int groups,
                float* residual) {
  Lanes squares = Lanes::Zero();
  for (int g = 0; g < groups; ++g) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(g) * kLanes;
    Lanes sum = ConstLanes(observed + at);
    for (int k = 0; k < terms.size; ++k) {
      sum -= terms.factors[k] * ConstLanes(stack.data() + terms.rows[k] * stack.cols() + at);
    }
    MutableLanes(residual + at) = sum;
    squares += sum * sum;
  }
  return squares.cast<double>().sum();
}

// ⟨stack rows 4·bone … 4·bone + 3, residual⟩.
template <class Stack>
Eigen::Vector4d Products(const Stack& stack, int bone, const float* residual, int groups) {
  const float* const rows = stack.data() + 4 * bone * stack.cols();
  const std::ptrdiff_t stride = stack.cols();
  Lanes sums[4] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
  for (int g = 0; g < groups; ++g) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(g) * kLanes;
    const Lanes e = ConstLanes(residual + at);
    for (int c = 0; c < 4; ++c) sums[c] += e * ConstLanes(rows + c * stride + at);
  }
  Eigen::Vector4d products;
  for (int c = 0; c < 4; ++c) products[c] = sums[c].cast<double>().sum();
  return products;
}

template <class Matrix>
void AddCross(const Terms& terms, const float* residual, int groups, Matrix& cross) {
  for (int k = 0; k < terms.size; ++k) {
    float* const row = cross.data() + terms.rows[k] * cross.cols();
    const float factor = terms.factors[k];
    for (int g = 0; g < groups; ++g) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(g) * kLanes;
      MutableLanes(row + at) += factor * ConstLanes(residual + at);
    }
  }
}

// Blocks on and below the diagonal of Σ u uᵀ.
void AddSecond(const Terms& terms, Eigen::MatrixXd& second) {
  for (int a = 0; a < terms.size; a += 4) {
    const Eigen::Vector4d left =
        Eigen::Map<const Eigen::Vector4f>(terms.factors + a).cast<double>();
    for (int b = 0; b < terms.size; b += 4) {
      if (terms.rows[b] > terms.rows[a]) continue;
      const Eigen::Vector4d right =
          Eigen::Map<const Eigen::Vector4f>(terms.factors + b).cast<double>();
      second.block<4, 4>(terms.rows[a], terms.rows[b]) += left * right.transpose();
    }
  }
}

// Keeps the non-zero weights, largest first.
void StoreSparse(const CandidateWeights& w, const std::vector<std::uint8_t>& candidates, int row,
                 RowWeights& weights) {
  std::array<int, kMaxCandidates> order;
  int size = 0;
  for (int j = 0; j < static_cast<int>(candidates.size()); ++j) {
    if (w[j] > 0.0) order[size++] = j;
  }
  std::sort(order.begin(), order.begin() + size,
            [&](int a, int b) { return w[a] > w[b] || (w[a] == w[b] && a < b); });
  weights.bones[row].fill(0);
  weights.weights[row].fill(0.0f);
  for (int k = 0; k < size; ++k) {
    weights.bones[row][k] = candidates[order[k]];
    weights.weights[row][k] = static_cast<float>(w[order[k]]);
  }
}

CandidateWeights Spread(const RowWeights& weights, int row,
                        const std::vector<std::uint8_t>& candidates) {
  CandidateWeights w{};
  double sum = 0.0;
  for (int k = 0; k < kMaxInfluences; ++k) {
    const float weight = weights.weights[row][k];
    if (!(weight > 0.0f)) continue;
    const auto found = std::find(candidates.begin(), candidates.end(), weights.bones[row][k]);
    w[found - candidates.begin()] = weight;
    sum += weight;
  }
  for (double& weight : w) weight /= sum;
  return w;
}

}  // namespace

WeightStep::WeightStep(const PackedExamples& examples, std::vector<std::uint8_t> label_of_row,
                       BoneGraph candidates, int influences, WorkerTeam& team)
    : examples_(examples),
      label_of_row_(std::move(label_of_row)),
      candidates_(std::move(candidates)),
      influences_(influences),
      team_(team),
      chunks_(kRowChunks) {
  Require(influences >= 1 && influences <= kMaxInfluences, "WeightStep: {} influences", influences);
  const int bones = static_cast<int>(candidates_.size());
  for (const auto& list : candidates_) {
    Require(!list.empty() && list.size() <= kMaxCandidates, "WeightStep: {} candidates",
            list.size());
  }
  stack_.setZero(4 * bones, examples_.stride());
  product_.resize(4 * bones, 4 * bones);
  forms_.resize(static_cast<std::size_t>(bones) * bones);
  for (Chunk& chunk : chunks_) {
    chunk.residual.assign(examples_.stride(), 0.0f);
    chunk.cross.resize(4 * bones, examples_.stride());
    chunk.second.resize(4 * bones, 4 * bones);
  }
}

WeightStep::~WeightStep() = default;

void WeightStep::Prepare(const BoneStack& stack) {
  const int bones = static_cast<int>(candidates_.size());
  stack_.leftCols(stack.cols()) = stack.cast<float>();
  product_.noalias() = stack * stack.transpose();
  for (int a = 0; a < bones; ++a) {
    for (int b = 0; b < bones; ++b) {
      forms_[static_cast<std::size_t>(a) * bones + b] = product_.block<4, 4>(4 * a, 4 * b);
    }
  }
}

int WeightStep::ChunkBegin(int chunk) const {
  return static_cast<int>(static_cast<std::int64_t>(examples_.vertex_count()) * chunk / kRowChunks);
}

void WeightStep::Solve(const BoneStack& stack, RowWeights& weights, SkinMoments& moments) {
  Prepare(stack);
  team_.For(kRowChunks, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      chunks_[c].SetZero();
      for (int row = ChunkBegin(c); row < ChunkBegin(c + 1); ++row) {
        SolveRow(row, chunks_[c], weights);
        GatherRow(row, chunks_[c], weights);
      }
    }
  });
  AddUp(moments);
}

void WeightStep::Gather(const BoneStack& stack, const RowWeights& weights, SkinMoments& moments) {
  Prepare(stack);
  team_.For(kRowChunks, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      chunks_[c].SetZero();
      for (int row = ChunkBegin(c); row < ChunkBegin(c + 1); ++row) {
        GatherRow(row, chunks_[c], weights);
      }
    }
  });
  AddUp(moments);
}

void WeightStep::SolveRow(int row, Chunk& chunk, RowWeights& weights) const {
  const std::vector<std::uint8_t>& candidates = candidates_[label_of_row_[row]];
  if (candidates.size() == 1) return;
  const RestPoint& rest = examples_.Rest(row);
  Residual(stack_, Terms(weights, row, rest), examples_.Row(row), examples_.groups(),
           chunk.residual.data());
  CandidateWeights w = Spread(weights, row, candidates);
  const Eigen::Vector4d point = rest.cast<double>();
  SimplexQp qp;
  qp.size = static_cast<int>(candidates.size());
  for (int a = 0; a < qp.size; ++a) {
    const Eigen::Matrix4d* const forms = forms_.data() + candidates[a] * candidates_.size();
    for (int b = 0; b <= a; ++b) {
      qp.gram[a][b] = qp.gram[b][a] = point.dot(forms[candidates[b]] * point);
    }
  }
  for (int a = 0; a < qp.size; ++a) {
    qp.target[a] =
        point.dot(Products(stack_, candidates[a], chunk.residual.data(), examples_.groups()));
    for (int b = 0; b < qp.size; ++b) qp.target[a] += qp.gram[a][b] * w[b];
  }
  MinimizeSparseOnSimplex(qp, influences_, w);
  StoreSparse(w, candidates, row, weights);
}

void WeightStep::GatherRow(int row, Chunk& chunk, const RowWeights& weights) const {
  const Terms terms(weights, row, examples_.Rest(row));
  chunk.energy +=
      Residual(stack_, terms, examples_.Row(row), examples_.groups(), chunk.residual.data());
  AddCross(terms, chunk.residual.data(), examples_.groups(), chunk.cross);
  AddSecond(terms, chunk.second);
}

void WeightStep::AddUp(SkinMoments& moments) const {
  moments.SetZero();
  for (const Chunk& chunk : chunks_) {
    moments.energy += chunk.energy;
    moments.second += chunk.second;
    moments.cross += chunk.cross.leftCols(moments.cross.cols()).cast<double>();
  }
  moments.second.triangularView<Eigen::StrictlyUpper>() = moments.second.transpose();
}

}  // namespace vitruvia::skinning
