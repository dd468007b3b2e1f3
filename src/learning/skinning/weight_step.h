// The weight half of an alternation: the optimal weights of every vertex for given bone transforms.
#pragma once

#include <cstdint>
#include <vector>

#include "core/worker_team.h"
#include "learning/skinning/bone_stack.h"
#include "learning/skinning/labels.h"
#include "learning/skinning/packed_examples.h"

namespace vitruvia::skinning {

// The weights of the rows of PackedExamples; unused slots have weight 0 and name bone 0.
using RowWeights = SkinWeights;

class WeightStep {
 public:
  // Every row chooses among candidates[its label], at most kMaxCandidates bones, and gets at most
  // `influences` (≤ kMaxInfluences) of them. `examples` must outlive this.
  WeightStep(const PackedExamples& examples, std::vector<std::uint8_t> label_of_row,
             BoneGraph candidates, int influences, WorkerTeam& team);
  ~WeightStep();

  // Replaces the weights of each vertex by the best among its candidates, and gathers the moments
  // at the new weights. The energy does not rise.
  void Solve(const BoneStack& stack, RowWeights& weights, SkinMoments& moments);

  // The moments at given weights.
  void Gather(const BoneStack& stack, const RowWeights& weights, SkinMoments& moments);

 private:
  struct Chunk;

  void Prepare(const BoneStack& stack);
  void SolveRow(int row, Chunk& chunk, RowWeights& weights) const;
  void GatherRow(int row, Chunk& chunk, const RowWeights& weights) const;
  void AddUp(SkinMoments& moments) const;
  int ChunkBegin(int chunk) const;

  const PackedExamples& examples_;
  std::vector<std::uint8_t> label_of_row_;
  BoneGraph candidates_;
  int influences_;
  WorkerTeam& team_;
  // 4B × stride, padded as the rows are.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> stack_;
  Eigen::MatrixXd product_;             // stack · stackᵀ, 4B × 4B
  std::vector<Eigen::Matrix4d> forms_;  // for each pair of bones: quadratic form of the product of
                                        // a vertex's two places
  std::vector<Chunk> chunks_;
};

}  // namespace vitruvia::skinning
