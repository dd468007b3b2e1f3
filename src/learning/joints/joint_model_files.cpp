// The joint model on disk (see joint_model.h).
#include <bit>
#include <cmath>
#include <cstring>

#include "config/stored_data.h"
#include "core/error.h"
#include "core/files.h"
#include "learning/joints/joint_model.h"

namespace vitruvia::joints {
namespace fs = std::filesystem;
namespace {

using Node = VotingTree::Node;
using Leaf = VotingTree::Leaf;

constexpr const char* kTreesFile = "trees.bin";
static_assert(std::endian::native == std::endian::little, "nodes are copied as they lie");
static_assert(sizeof(Node) == 32, "eight numbers of four bytes");
static_assert(sizeof(Leaf) == 20 * kLeafVotes, "five numbers of four bytes for each vote");

struct ModelHeader {
  static constexpr StoredFormat kFormat{"vitruvia-joint-model", 2, 2, "learn the joints again"};

  std::vector<std::string> points;
  int walk_trees = 0;
  std::vector<int> nodes, leaves;
  nlohmann::json learnt_from = nlohmann::json::object();

  void Describe(Fields& f) {
    f.Texts("points", points, {.meaning = "names of the points that are found, in order"});
    f.Integer("walk_trees", walk_trees,
              {.meaning = "number of walk trees of each point; the last trees in trees.bin, point "
                          "after point"});
    f.Integers("nodes", nodes, {.meaning = "number of nodes of each tree in trees.bin"});
    f.Integers("leaves", leaves, {.meaning = "number of leaves of each tree in trees.bin"});
    f.FreeJson("learnt_from", learnt_from, {.meaning = "settings that the model was learnt with"});
  }
};

std::vector<std::string> PointNames() {
  std::vector<std::string> names;
  for (const BodyPointInfo& point : BodyPoints()) names.push_back(point.name);
  return names;
}

bool IsFinite(const Leaf& leaf) {
  for (const PointVote& vote : leaf) {
    for (const float x : {vote.deviation_m, vote.offset_m[0], vote.offset_m[1], vote.offset_m[2]}) {
      if (!std::isfinite(x)) return false;
    }
  }
  return true;
}

std::string TreeProblem(const VotingTree& tree) {
  const auto nodes = static_cast<std::int32_t>(tree.nodes.size());
  const auto leaves = static_cast<std::int32_t>(tree.leaves.size());
  for (std::int32_t i = 0; i < nodes; ++i) {
    const Node& node = tree.nodes[i];
    const bool is_leaf = node.left == -1;
    if (!is_leaf && (node.left <= i || node.left + 1 >= nodes))
      return fmt::format("node {} of {} names {} as the next", i, nodes, node.left);
    if (is_leaf && (node.leaf < 0 || node.leaf >= leaves))
      return fmt::format("node {} names leaf {} of {}", i, node.leaf, leaves);
    const auto kind = static_cast<std::int32_t>(node.feature.kind);
    if (kind != 0 && kind != 1) return fmt::format("node {} has a feature of kind {}", i, kind);
    for (const float x : {node.feature.x, node.feature.y, node.feature.other_x,
                          node.feature.other_y, node.threshold}) {
      if (!std::isfinite(x)) return fmt::format("node {} holds a number that is not finite", i);
    }
  }
  for (std::int32_t i = 0; i < leaves; ++i) {
    if (!IsFinite(tree.leaves[i]))
      return fmt::format("leaf {} holds a number that is not finite", i);
    for (const PointVote& vote : tree.leaves[i]) {
      if (vote.point < -1 || vote.point >= kBodyPointCount)
        return fmt::format("leaf {} votes for point {} of {}", i, vote.point, kBodyPointCount);
    }
  }
  return "";
}

void CheckHeader(const ModelHeader& header, const fs::path& file) {
  if (header.points != PointNames()) {
    throw DataError(fmt::format("{}: points: expected {}, got {}", file.string(),
                                fmt::join(PointNames(), ", "), fmt::join(header.points, ", ")));
  }
  if (header.nodes.empty() || header.nodes.size() != header.leaves.size()) {
    throw DataError(
        fmt::format("{}: {} numbers of nodes and {} of leaves, expected one of each "
                    "for every tree, of which there is one at least",
                    file.string(), header.nodes.size(), header.leaves.size()));
  }
}

// Takes `count` records off the front of the bytes that are left.
template <class Record>
std::vector<Record> Take(int count, std::string_view& left, const fs::path& file) {
  const std::size_t size = static_cast<std::size_t>(std::max(0, count)) * sizeof(Record);
  if (count < 1 || size > left.size()) {
    throw DataError(fmt::format("{}: too short for the nodes and leaves that {} counts",
                                file.string(), kJointModelFile));
  }
  std::vector<Record> records(static_cast<std::size_t>(count));
  std::memcpy(static_cast<void*>(records.data()), left.data(), size);
  left.remove_prefix(size);
  return records;
}

template <class Record>
void Append(const std::vector<Record>& records, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(records.data()), records.size() * sizeof(Record));
}

}  // namespace

void WriteJointModel(const fs::path& folder, const JointModel& model,
                     const nlohmann::json& learnt_from) {
  ModelHeader header;
  header.points = PointNames();
  header.learnt_from = learnt_from;
  header.walk_trees = static_cast<int>(model.walks.front().size());
  std::string bytes;
  const auto append = [&](const std::vector<VotingTree>& trees) {
    for (const VotingTree& tree : trees) {
      header.nodes.push_back(static_cast<int>(tree.nodes.size()));
      header.leaves.push_back(static_cast<int>(tree.leaves.size()));
      Append(tree.nodes, bytes);
      Append(tree.leaves, bytes);
    }
  };
  append(model.trees);
  for (const auto& walk : model.walks) append(walk);
  StagedFolder staged(folder, kJointModelFile);
  WriteStored(staged.path() / kJointModelFile, header);
  WriteWholeFile(staged.path() / kTreesFile, bytes);
  staged.Commit();
}

nlohmann::json ReadLearntFrom(const fs::path& folder) {
  return ReadStored<ModelHeader>(folder / kJointModelFile).learnt_from;
}

JointModel ReadJointModel(const fs::path& folder) {
  const fs::path header_file = folder / kJointModelFile, trees_file = folder / kTreesFile;
  const auto header = ReadStored<ModelHeader>(header_file);
  CheckHeader(header, header_file);
  const std::string bytes = ReadWholeFile(trees_file);
  std::string_view left = bytes;
  std::vector<VotingTree> trees;
  for (std::size_t t = 0; t < header.nodes.size(); ++t) {
    VotingTree tree;
    tree.nodes = Take<Node>(header.nodes[t], left, trees_file);
    tree.leaves = Take<Leaf>(header.leaves[t], left, trees_file);
    const std::string problem = TreeProblem(tree);
    if (!problem.empty())
      throw DataError(fmt::format("{}: tree {}: {}", trees_file.string(), t, problem));
    trees.push_back(std::move(tree));
  }
  if (!left.empty()) {
    throw DataError(fmt::format("{}: {} bytes more than {} counts", trees_file.string(),
                                left.size(), kJointModelFile));
  }
  JointModel model;
  for (auto walk = model.walks.rbegin(); walk != model.walks.rend(); ++walk) {
    walk->assign(std::make_move_iterator(trees.end() - header.walk_trees),
                 std::make_move_iterator(trees.end()));
    trees.resize(trees.size() - static_cast<std::size_t>(header.walk_trees));
  }
  model.trees = std::move(trees);
  return model;
}

}  // namespace vitruvia::joints
