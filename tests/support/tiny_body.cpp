#include "support/tiny_body.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/error.h"

namespace vitruvia {
namespace {

// Planes that cut space into boxes. Between two of them along each axis lies one segment.
constexpr std::array kX{-0.85, -0.70, -0.45, -0.18, -0.10, -0.05,
                        0.05,  0.10,  0.18,  0.45,  0.70,  0.85};
constexpr std::array kY{0.0, 0.08, 0.48, 0.90, 1.05, 1.20, 1.35, 1.45, 1.52, 1.75};
constexpr std::array kZ{-0.10, -0.05, 0.05, 0.10, 0.25};

// The bone that fills a segment, or -1 where there is no body.
int BoneAt(double x, double y, double z) {
  const bool left = x > 0.0;
  const double side = std::abs(x);
  const auto sided = [left](BoneId on_the_left) {
    const int bone = static_cast<int>(on_the_left);
    return left ? bone : Bones()[bone].mirror;
  };
  const bool core = std::abs(z) < 0.05, thick = std::abs(z) < 0.10;
  if (y > 1.52) return side < 0.10 && thick ? static_cast<int>(BoneId::kHead) : -1;
  if (y > 1.45) return side < 0.05 && core ? static_cast<int>(BoneId::kNeck) : -1;
  if (y > 1.35 && side > 0.18) {
    if (!core) return -1;
    if (side > 0.70) return sided(BoneId::kLeftHand);
    return sided(side > 0.45 ? BoneId::kLeftForearm : BoneId::kLeftUpperArm);
  }
  if (side > 0.18) return -1;
  if (y > 0.90) {
    if (!thick) return -1;
    return static_cast<int>(y > 1.20   ? BoneId::kChest
                            : y > 1.05 ? BoneId::kAbdomen
                                       : BoneId::kPelvis);
  }
  if (side < 0.05) return -1;
  if (y < 0.08) return sided(BoneId::kLeftFoot);
  if (!thick) return -1;
  return sided(y < 0.48 ? BoneId::kLeftShin : BoneId::kLeftThigh);
}

template <std::size_t N>
std::vector<double> Cut(const std::array<double, N>& planes, int pieces) {
  std::vector<double> cuts{planes[0]};
  for (std::size_t i = 1; i < N; ++i) {
    for (int k = 1; k <= pieces; ++k) {
      cuts.push_back(std::lerp(planes[i - 1], planes[i], static_cast<double>(k) / pieces));
    }
  }
  return cuts;
}

using Node = std::array<int, 3>;  // indices of planes along x, y, z

// The surface between filled and empty cells of the grid.
class Boxes {
 public:
  explicit Boxes(int pieces) : planes_{Cut(kX, pieces), Cut(kY, pieces), Cut(kZ, pieces)} {}

  void Build(QuadMesh& mesh, Eigen::MatrixXf& weights) {
    for (int x = 0; x < CellCount(0); ++x) {
      for (int y = 0; y < CellCount(1); ++y) {
        for (int z = 0; z < CellCount(2); ++z) AddCell({x, y, z}, mesh);
      }
    }
    weights.setZero(static_cast<Eigen::Index>(nodes_.size()), kBoneCount);
    for (const auto& [node, index] : nodes_) AddWeights(node, weights.row(index));
  }

 private:
  int CellCount(int axis) const { return static_cast<int>(planes_[axis].size()) - 1; }

  int BoneOf(const Node& cell) const {
    std::array<double, 3> middle{};
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= CellCount(axis)) return -1;
      middle[axis] = 0.5 * (planes_[axis][cell[axis]] + planes_[axis][cell[axis] + 1]);
    }
    return BoneAt(middle[0], middle[1], middle[2]);
  }

  std::int32_t VertexOf(const Node& node, QuadMesh& mesh) {
    const auto [found, is_new] =
        nodes_.try_emplace(node, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) {
      mesh.vertices.push_back(
          Vector3d(planes_[0][node[0]], planes_[1][node[1]], planes_[2][node[2]]).cast<float>());
    }
    return found->second;
  }

  // The quads of a filled cell that face empty ones, counter-clockwise seen from there.
  void AddCell(const Node& cell, QuadMesh& mesh) {
    if (BoneOf(cell) < 0) return;
    for (int axis = 0; axis < 3; ++axis) {
      const int second = (axis + 1) % 3, third = (axis + 2) % 3;
      for (const int side : {0, 1}) {
        Node neighbor = cell;
        neighbor[axis] += 2 * side - 1;
        if (BoneOf(neighbor) >= 0) continue;
        constexpr std::array<std::array<int, 2>, 4> kAround{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        Quad quad{};
        for (int corner = 0; corner < 4; ++corner) {
          const auto& step = kAround[side == 1 ? corner : 3 - corner];
          Node node = cell;
          node[axis] += side;
          node[second] += step[0];
          node[third] += step[1];
          quad[corner] = VertexOf(node, mesh);
        }
        mesh.quads.push_back(quad);
      }
    }
  }

  // Equal shares of the bones of the filled cells round a node.
  template <class Row>
  void AddWeights(const Node& node, Row row) const {
    for (int corner = 0; corner < 8; ++corner) {
      const int bone = BoneOf(
          {node[0] - (corner & 1), node[1] - (corner >> 1 & 1), node[2] - (corner >> 2 & 1)});
      if (bone >= 0) row(bone) = 1.0f;
    }
    row /= row.sum();
  }

  std::array<std::vector<double>, 3> planes_;
  std::map<Node, std::int32_t> nodes_;
};

Skeleton TinySkeleton() {
  Skeleton s;
  const auto put = [&s](BoneId bone, const Vector3d& joint, const Vector3d& tip) {
    const int b = static_cast<int>(bone), m = Bones()[b].mirror;
    const Vector3d flip(-1.0, 1.0, 1.0);
    s.joints[m] = joint.cwiseProduct(flip);
    s.tips[m] = tip.cwiseProduct(flip);
    s.joints[b] = joint;
    s.tips[b] = tip;
  };
  put(BoneId::kPelvis, {0.0, 0.95, 0.0}, {0.0, 1.05, 0.0});
  put(BoneId::kAbdomen, {0.0, 1.05, 0.0}, {0.0, 1.20, 0.0});
  put(BoneId::kChest, {0.0, 1.20, 0.0}, {0.0, 1.45, 0.0});
  put(BoneId::kNeck, {0.0, 1.45, 0.0}, {0.0, 1.52, 0.0});
  put(BoneId::kHead, {0.0, 1.52, 0.0}, {0.0, 1.75, 0.0});
  put(BoneId::kLeftUpperArm, {0.18, 1.40, 0.0}, {0.45, 1.40, 0.0});
  put(BoneId::kLeftForearm, {0.45, 1.40, 0.0}, {0.70, 1.40, 0.0});
  put(BoneId::kLeftHand, {0.70, 1.40, 0.0}, {0.85, 1.40, 0.0});
  put(BoneId::kLeftThigh, {0.115, 0.90, 0.0}, {0.115, 0.48, 0.0});
  put(BoneId::kLeftShin, {0.115, 0.48, 0.0}, {0.115, 0.08, 0.0});
  put(BoneId::kLeftFoot, {0.115, 0.08, 0.0}, {0.115, 0.04, 0.25});
  return s;
}

}  // namespace

BodyModel TinyBody(int cells_per_segment) {
  Require(cells_per_segment >= 1, "TinyBody: {} cells per segment", cells_per_segment);
  QuadMesh mesh;
  Eigen::MatrixXf weights;
  Boxes(cells_per_segment).Build(mesh, weights);
  BodyModel body;
  body.name = "tiny";
  body.rest = Triangulated(mesh);
  body.weights = Sparsified(weights);
  body.skeleton = TinySkeleton();
  body.attributes = {1.75, 70.0, Sex::kMale};
  return body;
}

}  // namespace vitruvia
