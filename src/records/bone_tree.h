// A tree of bones or joints that a run without frames stores for its report: tree.json in the run's
// folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/stored_data.h"

namespace vitruvia {

struct BoneTree {
  static constexpr StoredFormat kFormat{"vitruvia-tree", 1, 1, "run the experiment again"};

  struct Node {
    std::string name, detail;
    int parent = -1;  // index, smaller than the node's own; -1: the root

    void Describe(Fields& fields);
  };
  std::string title;
  std::vector<Node> nodes;

  void Describe(Fields& fields);
  std::string Problem() const;
};

bool HasBoneTree(const std::filesystem::path& run_folder);
void WriteBoneTree(const std::filesystem::path& run_folder, const BoneTree& tree);
// DataError if the file is missing or damaged.
BoneTree ReadBoneTree(const std::filesystem::path& run_folder);

}  // namespace vitruvia
