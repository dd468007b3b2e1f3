// Names, header and small JSON files of the sequence format: shared by its reader and writer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/json_settings.h"
#include "sequence/sequence.h"

namespace vitruvia {

inline constexpr const char* kSequenceFormat = "vitruvia-sequence";
inline constexpr int kSequenceVersion = 2;  // the newest that is written and read
inline constexpr int kFirstSequenceVersion = 1;

// Paths of the files of a sequence.
struct SequenceFiles {
  std::filesystem::path folder;

  std::filesystem::path Header() const { return folder / "sequence.json"; }
  std::filesystem::path DepthFolder() const { return folder / "depth"; }
  std::filesystem::path Depth(int frame) const { return DepthFolder() / FrameName(frame); }
  std::filesystem::path MaskFolder() const { return folder / "mask"; }
  std::filesystem::path Mask(int frame) const { return MaskFolder() / FrameName(frame); }
  std::filesystem::path EmptyRoomFolder() const { return folder / "empty_room"; }
  std::filesystem::path EmptyRoom(int frame) const { return EmptyRoomFolder() / FrameName(frame); }
  std::filesystem::path Preview() const { return folder / "preview.png"; }
  std::filesystem::path TruthFolder() const { return folder / "truth"; }
  std::filesystem::path Joints() const { return TruthFolder() / "joints.json"; }
  std::filesystem::path Mesh() const { return TruthFolder() / "mesh.ply"; }
  std::filesystem::path Vertices() const { return TruthFolder() / "vertices.bin"; }
  std::filesystem::path SurfaceFolder() const { return TruthFolder() / "surfaces"; }
  std::filesystem::path Surface(int frame) const { return SurfaceFolder() / SurfaceName(frame); }
  std::filesystem::path ViewFolder(const std::string& view) const {
    return folder / "views" / view;
  }
  std::filesystem::path ViewDepth(const std::string& view, int frame) const {
    return ViewFolder(view) / FrameName(frame);
  }
  std::filesystem::path Subject() const { return folder / "subject"; }

  static std::string FrameName(int frame);    // 000000.png
  static std::string SurfaceName(int frame);  // 000000.ply
};

// sequence.json. Both throw DataError naming the key where a value is missing or wrong.
SequenceInfo ReadSequenceInfo(const std::filesystem::path& file);
Json SequenceInfoJson(const SequenceInfo& info);
// The oldest version of the format that can represent `info`: readers of that version can read the
// sequence.
int VersionOf(const SequenceInfo& info);
// "" or the reason why `info` is inconsistent.
std::string SequenceInfoProblem(const SequenceInfo& info);

// truth/joints.json: one JointTruth for each frame, in the order of info.joints. The position of a
// joint that is not known is null.
std::vector<JointTruth> ReadJointTruth(const std::filesystem::path& file, const SequenceInfo& info);
Json JointTruthJson(const std::vector<std::string>& names, const std::vector<JointTruth>& frames);

// "" or the problem of one frame's joints.
std::string JointTruthProblem(const JointTruth& joints, std::size_t joint_count);

}  // namespace vitruvia
