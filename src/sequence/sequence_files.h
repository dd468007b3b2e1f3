// Names, header and small JSON files of the sequence format: shared by its reader and writer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "sequence/sequence.h"

namespace vitruvia {

inline constexpr const char* kSequenceFormat = "vitruvia-sequence";
inline constexpr int kSequenceVersion = 1;

// Where the parts of a sequence lie.
struct SequenceFiles {
  std::filesystem::path folder;

  std::filesystem::path Header() const { return folder / "sequence.json"; }
  std::filesystem::path DepthFolder() const { return folder / "depth"; }
  std::filesystem::path Depth(int frame) const { return DepthFolder() / FrameName(frame); }
  std::filesystem::path MaskFolder() const { return folder / "mask"; }
  std::filesystem::path Mask(int frame) const { return MaskFolder() / FrameName(frame); }
  std::filesystem::path TruthFolder() const { return folder / "truth"; }
  std::filesystem::path Joints() const { return TruthFolder() / "joints.json"; }
  std::filesystem::path Mesh() const { return TruthFolder() / "mesh.ply"; }
  std::filesystem::path Vertices() const { return TruthFolder() / "vertices.bin"; }
  std::filesystem::path Subject() const { return folder / "subject"; }

  static std::string FrameName(int frame);  // 000000.png
};

// sequence.json. Both throw DataError naming the key where a value is missing or wrong.
SequenceInfo ReadSequenceInfo(const std::filesystem::path& file);
Json SequenceInfoJson(const SequenceInfo& info);
// "" or why no sequence can be as `info` says.
std::string SequenceInfoProblem(const SequenceInfo& info);

// truth/joints.json: one JointTruth for each frame, in the order of info.joints. The position of a
// joint that is not known is null.
std::vector<JointTruth> ReadJointTruth(const std::filesystem::path& file, const SequenceInfo& info);
Json JointTruthJson(const std::vector<std::string>& names, const std::vector<JointTruth>& frames);

// "" or what is wrong with one frame's joints.
std::string JointTruthProblem(const JointTruth& joints, std::size_t joint_count);

}  // namespace vitruvia
