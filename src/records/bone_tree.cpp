#include "records/bone_tree.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTreeFile = "tree.json";

}  // namespace

void BoneTree::Node::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "name of the node"});
  f.Text("detail", detail, {.meaning = "what the node is made of", .optional = true});
  f.Integer("parent", parent,
            {.meaning = "index of the node that it hangs on; -1 is the root", .min = -1});
}

void BoneTree::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "title of the drawing"});
  f.List("nodes", nodes, {.meaning = "nodes, parents first"});
}

std::string BoneTree::Problem() const {
  if (nodes.empty()) return "nodes: expected at least one";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_root = nodes[i].parent == -1;
    if (is_root != (i == 0) || nodes[i].parent >= static_cast<int>(i))
      return fmt::format(
          "nodes[{}].parent: expected -1 for the first and an earlier node for "
          "others, got {}",
          i, nodes[i].parent);
  }
  return "";
}

bool HasBoneTree(const fs::path& run_folder) { return fs::is_regular_file(run_folder / kTreeFile); }

void WriteBoneTree(const fs::path& run_folder, const BoneTree& tree) {
  WriteStored(run_folder / kTreeFile, tree);
}

BoneTree ReadBoneTree(const fs::path& run_folder) {
  return ReadStored<BoneTree>(run_folder / kTreeFile);
}

}  // namespace vitruvia
