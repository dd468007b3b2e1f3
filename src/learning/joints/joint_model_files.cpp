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

using Node = RegressionTree::Node;

constexpr const char* kTreesFile = "trees.bin";
static_assert(std::endian::native == std::endian::little, "nodes are copied as they lie");
static_assert(sizeof(Node) == 40, "ten numbers of four bytes");

struct ModelHeader {
  static constexpr StoredFormat kFormat{"vitruvia-joint-model", 1, 1, "learn the joints again"};

  std::vector<std::string> points;
  std::vector<double> jitter_m;
  int trees = 1;
  std::vector<int> nodes;
  nlohmann::json learnt_from = nlohmann::json::object();

  void Describe(Fields& f) {
    f.Texts("points", points, {.meaning = "names of the points that are found, in order"});
    f.NumberList(
        "jitter_m", jitter_m,
        {.meaning = "for each stage, how far round the places that earlier stages reach its "
                    "trees have learnt to start",
         .unit = "m",
         .min = 0.0});
    f.Integer("trees", trees, {.meaning = "trees for each stage and point", .min = 1, .max = 1000});
    f.Integers("nodes", nodes,
               {.meaning = "number of nodes of each tree in trees.bin: stage by stage, point by "
                           "point"});
    f.FreeJson("learnt_from", learnt_from, {.meaning = "settings that the model was learnt with"});
  }
};

std::vector<std::string> PointNames() {
  std::vector<std::string> names;
  for (const BodyPointInfo& point : BodyPoints()) names.push_back(point.name);
  return names;
}

template <class Visit>
void ForTrees(JointModel& model, const Visit& visit) {
  for (JointStage& stage : model.stages) {
    for (Forest& forest : stage.forests) {
      for (RegressionTree& tree : forest) visit(tree);
    }
  }
}

std::string TreeProblem(const RegressionTree& tree) {
  const auto count = static_cast<std::int32_t>(tree.nodes.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Node& node = tree.nodes[i];
    const bool is_leaf = node.left == -1;
    if (!is_leaf && (node.left <= i || node.left + 1 >= count)) {
      return fmt::format("node {} of {} names {} as the next", i, count, node.left);
    }
    const auto kind = static_cast<std::int32_t>(node.feature.kind);
    if (kind != 0 && kind != 1) return fmt::format("node {} has a feature of kind {}", i, kind);
    for (const float x :
         {node.feature.x, node.feature.y, node.feature.other_x, node.feature.other_y,
          node.threshold, node.offset_m[0], node.offset_m[1], node.offset_m[2]}) {
      if (!std::isfinite(x)) return fmt::format("node {} holds a number that is not finite", i);
    }
  }
  return "";
}

JointModel EmptyModel(const ModelHeader& header) {
  JointModel model;
  for (const double jitter_m : header.jitter_m) {
    JointStage& stage = model.stages.emplace_back();
    stage.jitter_m = jitter_m;
    for (Forest& forest : stage.forests) forest.resize(static_cast<std::size_t>(header.trees));
  }
  return model;
}

void CheckHeader(const ModelHeader& header, const fs::path& file) {
  if (header.points != PointNames()) {
    throw DataError(fmt::format("{}: points: expected {}, got {}", file.string(),
                                fmt::join(PointNames(), ", "), fmt::join(header.points, ", ")));
  }
  const std::size_t trees =
      header.jitter_m.size() * kBodyPointCount * static_cast<std::size_t>(header.trees);
  if (header.nodes.size() != trees || trees == 0) {
    throw DataError(fmt::format("{}: nodes: {} numbers, expected one for each of {} trees",
                                file.string(), header.nodes.size(), trees));
  }
}

}  // namespace

void WriteJointModel(const fs::path& folder, const JointModel& model,
                     const nlohmann::json& learnt_from) {
  ModelHeader header;
  header.learnt_from = learnt_from;
  header.points = PointNames();
  std::string bytes;
  JointModel copy = model;
  for (const JointStage& stage : model.stages) {
    header.jitter_m.push_back(stage.jitter_m);
    header.trees = static_cast<int>(stage.forests.front().size());
  }
  ForTrees(copy, [&](const RegressionTree& tree) {
    header.nodes.push_back(static_cast<int>(tree.nodes.size()));
    bytes.append(reinterpret_cast<const char*>(tree.nodes.data()),
                 tree.nodes.size() * sizeof(Node));
  });
  StagedFolder staged(folder, kJointModelFile);
  WriteStored(staged.path() / kJointModelFile, header, -1);
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
  JointModel model = EmptyModel(header);
  const std::string bytes = ReadWholeFile(trees_file);
  std::size_t at = 0, tree_number = 0;
  ForTrees(model, [&](RegressionTree& tree) {
    const int count = header.nodes[tree_number++];
    const std::size_t size = static_cast<std::size_t>(std::max(0, count)) * sizeof(Node);
    if (count < 1 || at + size > bytes.size()) {
      throw DataError(fmt::format("{}: {} bytes, too few for the nodes that {} counts",
                                  trees_file.string(), bytes.size(), kJointModelFile));
    }
    tree.nodes.resize(static_cast<std::size_t>(count));
    std::memcpy(tree.nodes.data(), bytes.data() + at, size);
    at += size;
    const std::string problem = TreeProblem(tree);
    if (!problem.empty()) {
      throw DataError(fmt::format("{}: tree {}: {}", trees_file.string(), tree_number, problem));
    }
  });
  if (at != bytes.size()) {
    throw DataError(
        fmt::format("{}: {} bytes, expected {}", trees_file.string(), bytes.size(), at));
  }
  return model;
}

}  // namespace vitruvia::joints
