#include "learning/skinning/rigid_pieces.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/worker_team.h"
#include "math/rigid.h"
#include "math/rigid_fit.h"

namespace vitruvia::skinning {
namespace {

constexpr int kRoundsAfterSplit = 4;  // of refitting and reassigning
constexpr int kRoundsAtEnd = 20;      // at most; they end when no vertex changes sides
constexpr std::size_t kSeeds = 20;    // vertices that a new piece begins with
constexpr std::size_t kFewestToSplit = 2 * kSeeds;

class PieceFinder {
 public:
  PieceFinder(const Examples& examples, int threads)
      : examples_(examples),
        team_(threads),
        labels_(examples.rest.size(), 0),
        errors_(examples.rest.size(), 0.0f) {
    AddPiece();
    Refine(1);
  }

  // False if no piece is large enough to be split.
  bool SplitWorst() {
    const int worst = WorstPiece();
    if (worst < 0) return false;
    AddPiece();
    for (const int vertex : SeedsIn(worst)) {
      labels_[vertex] = static_cast<std::uint8_t>(pieces_.size() - 1);
    }
    FitPieces();
    Refine(kRoundsAfterSplit);
    return true;
  }

  void Refine(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      FitPieces();
      if (!Reassign()) return;
    }
  }

  const Labels& labels() const { return labels_; }
  int pieces() const { return static_cast<int>(pieces_.size()); }

 private:
  using Motion = std::vector<Rigidf>;  // per pose

  void AddPiece() { pieces_.emplace_back(examples_.poses.size()); }

  // The best rigid motion of each piece; pieces of fewer than three vertices keep theirs.
  void FitPieces() {
    std::vector<std::vector<int>> members(pieces_.size());
    for (std::size_t v = 0; v < labels_.size(); ++v) {
      members[labels_[v]].push_back(static_cast<int>(v));
    }
    team_.For(static_cast<int>(examples_.poses.size()), [&](int begin, int end) {
      for (int pose = begin; pose < end; ++pose) {
        for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
          if (members[piece].size() >= 3) pieces_[piece][pose] = Fitted(members[piece], pose);
        }
      }
    });
  }

  Rigidf Fitted(const std::vector<int>& members, int pose) const {
    const std::vector<Vector3f>& posed = examples_.poses[pose];
    const auto pair_at = [&](std::size_t i) {
      const int v = members[i];
      return PointPair{examples_.rest[v].cast<double>(), posed[v].cast<double>()};
    };
    return FitRigid(members.size(), pair_at).Cast<float>();
  }

  float Error(int vertex, const Motion& motion) const {
    const Vector3f& rest = examples_.rest[vertex];
    float sum = 0.0f;
    for (std::size_t pose = 0; pose < motion.size(); ++pose) {
      sum += (motion[pose] * rest - examples_.poses[pose][vertex]).squaredNorm();
    }
    return sum;
  }

  // True if a vertex changed sides.
  bool Reassign() {
    const Labels before = labels_;
    team_.For(static_cast<int>(labels_.size()), [&](int begin, int end) {
      for (int v = begin; v < end; ++v) {
        errors_[v] = std::numeric_limits<float>::infinity();
        for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
          const float error = Error(v, pieces_[piece]);
          if (error >= errors_[v]) continue;
          errors_[v] = error;
          labels_[v] = static_cast<std::uint8_t>(piece);
        }
      }
    });
    return labels_ != before;
  }

  int WorstPiece() const {
    std::vector<double> sums(pieces_.size(), 0.0);
    std::vector<std::size_t> sizes(pieces_.size(), 0);
    for (std::size_t v = 0; v < labels_.size(); ++v) {
      sums[labels_[v]] += errors_[v];
      ++sizes[labels_[v]];
    }
    int worst = -1;
    for (std::size_t piece = 0; piece < sums.size(); ++piece) {
      if (sizes[piece] < kFewestToSplit) continue;
      if (worst < 0 || sums[piece] > sums[worst]) worst = static_cast<int>(piece);
    }
    return worst;
  }

  // The piece's vertex of the largest error and those nearest to it at rest.
  std::vector<int> SeedsIn(int piece) const {
    std::vector<int> members;
    for (std::size_t v = 0; v < labels_.size(); ++v) {
      if (labels_[v] == piece) members.push_back(static_cast<int>(v));
    }
    const int seed = *std::max_element(members.begin(), members.end(),
                                       [&](int a, int b) { return errors_[a] < errors_[b]; });
    const auto distance = [&](int v) {
      return (examples_.rest[v] - examples_.rest[seed]).squaredNorm();
    };
    std::partial_sort(members.begin(), members.begin() + kSeeds, members.end(), [&](int a, int b) {
      return std::pair(distance(a), a) < std::pair(distance(b), b);
    });
    members.resize(kSeeds);
    return members;
  }

  const Examples& examples_;
  WorkerTeam team_;
  Labels labels_;
  std::vector<float> errors_;  // of each vertex under its piece's motion, summed over poses
  std::vector<Motion> pieces_;
};

}  // namespace

Labels FindRigidPieces(const Examples& examples, int count, int threads) {
  const std::string problem = ExamplesProblem(examples);
  Require(problem.empty(), "FindRigidPieces: {}", problem);
  Require(count >= 1 && count <= 256, "FindRigidPieces: {} pieces, expected 1 to 256", count);
  PieceFinder finder(examples, threads);
  while (finder.pieces() < count && finder.SplitWorst()) {
  }
  finder.Refine(kRoundsAtEnd);
  return finder.labels();
}

}  // namespace vitruvia::skinning
