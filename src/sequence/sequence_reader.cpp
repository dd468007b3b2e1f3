#include <algorithm>
#include <bit>
#include <fstream>
#include <set>

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/progress.h"
#include "geometry/depth_png.h"
#include "geometry/mask_png.h"
#include "geometry/mesh_io.h"
#include "sequence/sequence_files.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "vertices.bin is little-endian");
static_assert(sizeof(Vector3f) == 3 * sizeof(float));

// A folder must hold exactly the frames that the header states: a missing or an additional frame
// shows that the sequence was assembled wrongly.
void CheckFrameFiles(const fs::path& folder, int frames,
                     std::string (*name_of)(int) = SequenceFiles::FrameName) {
  for (int i = 0; i < frames; ++i) {
    const fs::path file = folder / name_of(i);
    if (!fs::is_regular_file(file)) {
      throw DataError(fmt::format("{}: frame {} is missing; sequence.json promises {} frames",
                                  file.string(), i, frames));
    }
  }
  std::set<std::string> surplus;
  for (const auto& entry : fs::directory_iterator(folder)) {
    surplus.insert(entry.path().filename().string());
  }
  for (int i = 0; i < frames; ++i) surplus.erase(name_of(i));
  if (!surplus.empty()) {
    throw DataError(fmt::format("{}: not part of the {} frames that sequence.json promises",
                                (folder / *surplus.begin()).string(), frames));
  }
}

// A part must be present or absent as sequence.json says, so that a lost part is not mistaken for
// one that never existed.
void RequireFolder(const fs::path& folder, bool there) {
  if (there && !fs::is_directory(folder))
    throw DataError(fmt::format("{}: folder is missing", folder.string()));
  if (!there && fs::exists(folder))
    throw DataError(
        fmt::format("{}: is there, but sequence.json says that there is none", folder.string()));
}

void RequireAbsent(const fs::path& file, const char* why) {
  if (!fs::exists(file)) return;
  throw DataError(fmt::format("{}: is there, but in sequence.json {}", file.string(), why));
}

std::size_t FrameBytes(const TriangleMesh& mesh) { return mesh.vertices.size() * sizeof(Vector3f); }

void CheckVerticesSize(const fs::path& file, int frames, const TriangleMesh& mesh) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw DataError(fmt::format("{}: cannot be opened for reading", file.string()));
  const std::uintmax_t expected = FrameBytes(mesh) * static_cast<std::uintmax_t>(frames);
  if (size != expected) {
    throw DataError(
        fmt::format("{}: expected {} bytes ({} frames × {} vertices of mesh.ply × 12), got {}",
                    file.string(), expected, frames, mesh.vertices.size(), size));
  }
}

void ApplyMask(const MaskImage& mask, DepthImage& depth) {
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    const std::uint8_t value = mask.pixels()[i];
    if (value == 0 || value == kForeignDepthMask) depth.pixels()[i] = 0.0f;
  }
}

}  // namespace

SequenceReader::SequenceReader(fs::path folder) : folder_(std::move(folder)) {
  if (!fs::is_directory(folder_)) {
    throw DataError(
        fmt::format("{}: is no folder; expected the folder of a sequence", folder_.string()));
  }
  const SequenceFiles files{folder_};
  info_ = ReadSequenceInfo(files.Header());
  RequireFolder(files.DepthFolder(), true);
  RequireFolder(files.TruthFolder(), info_.surface || info_.own_surfaces || !info_.joints.empty());
  RequireFolder(files.Subject(), info_.subject);
  CheckFrameFiles(files.DepthFolder(), info_.frames);
  has_masks_ = fs::exists(files.MaskFolder());
  if (has_masks_) CheckFrameFiles(files.MaskFolder(), info_.frames);
  for (const OtherView& view : info_.views) {
    RequireFolder(files.ViewFolder(view.name), true);
    CheckFrameFiles(files.ViewFolder(view.name), info_.frames);
  }
  ReadTruth();
  if (info_.subject) subject_ = ReadBodyModel(files.Subject());
}

void SequenceReader::ReadTruth() {
  const SequenceFiles files{folder_};
  if (info_.joints.empty()) {
    RequireAbsent(files.Joints(), "joints is empty");
  } else {
    true_joints_ = ReadJointTruth(files.Joints(), info_);
  }
  RequireFolder(files.SurfaceFolder(), info_.own_surfaces);
  if (info_.own_surfaces)
    CheckFrameFiles(files.SurfaceFolder(), info_.frames, SequenceFiles::SurfaceName);
  if (!info_.surface) {
    for (const fs::path& file : {files.Mesh(), files.Vertices()})
      RequireAbsent(file, "surface is false");
    return;
  }
  true_rest_mesh_ = ReadMesh(files.Mesh());
  CheckVerticesSize(files.Vertices(), info_.frames, true_rest_mesh_);
}

const BodyModel& SequenceReader::subject() const {
  if (info_.subject) return subject_;
  throw DataError(fmt::format(
      "{}: the sequence has no subject for a tracker; name the folder of one: --subject of track, "
      "or the subject of a variant in an experiment",
      folder_.string()));
}

const TriangleMesh& SequenceReader::true_rest_mesh() const {
  RequireSurface();
  return true_rest_mesh_;
}

void SequenceReader::RequireSurface() const {
  Require(info_.surface, "SequenceReader: {} has no true surface", folder_.string());
}

void SequenceReader::RequireFrame(int frame) const {
  Require(frame >= 0 && frame < info_.frames, "SequenceReader: frame {} of {}", frame,
          info_.frames);
}

DepthImage SequenceReader::ReadDepthWithRoom(int frame) const {
  RequireFrame(frame);
  return ReadDepthPng(SequenceFiles{folder_}.Depth(frame), info_.depth_unit_m, info_.camera.width,
                      info_.camera.height);
}

MaskImage SequenceReader::ReadMask(int frame) const {
  RequireFrame(frame);
  Require(has_masks_, "SequenceReader: {} has no masks", folder_.string());
  return ReadMaskPng(SequenceFiles{folder_}.Mask(frame), info_.camera.width, info_.camera.height);
}

DepthImage SequenceReader::ReadDepth(int frame) const {
  DepthImage depth = ReadDepthWithRoom(frame);
  if (has_masks_) ApplyMask(ReadMask(frame), depth);
  return depth;
}

const JointTruth& SequenceReader::true_joints(int frame) const {
  RequireFrame(frame);
  Require(!info_.joints.empty(), "SequenceReader: {} has no true joints", folder_.string());
  return true_joints_[static_cast<std::size_t>(frame)];
}

std::vector<Vector3f> SequenceReader::ReadTrueVertices(int frame) const {
  RequireFrame(frame);
  RequireSurface();
  const fs::path file = SequenceFiles{folder_}.Vertices();
  std::vector<Vector3f> vertices(true_rest_mesh_.vertices.size());
  const auto bytes = static_cast<std::streamsize>(FrameBytes(true_rest_mesh_));
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(frame) * bytes);
  stream.read(reinterpret_cast<char*>(vertices.data()), bytes);
  if (!stream || stream.gcount() != bytes) {
    throw DataError(fmt::format("{}: cut short in frame {}", file.string(), frame));
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      throw DataError(fmt::format("{}: frame {}, vertex {} is not finite: ({}, {}, {})",
                                  file.string(), frame, i, vertices[i].x(), vertices[i].y(),
                                  vertices[i].z()));
    }
  }
  return vertices;
}

TriangleMesh SequenceReader::ReadTrueSurface(int frame) const {
  RequireFrame(frame);
  Require(info_.own_surfaces, "SequenceReader: {} has no surfaces of their own", folder_.string());
  const fs::path file = SequenceFiles{folder_}.Surface(frame);
  TriangleMesh surface = ReadMesh(file);
  if (surface.triangles.empty())
    throw DataError(fmt::format("{}: expected a surface, found no triangles", file.string()));
  return surface;
}

DepthImage SequenceReader::ReadViewDepth(int view, int frame) const {
  RequireFrame(frame);
  const OtherView& other = info_.views.at(static_cast<std::size_t>(view));
  return ReadDepthPng(SequenceFiles{folder_}.ViewDepth(other.name, frame), info_.depth_unit_m,
                      other.camera.width, other.camera.height);
}

std::string SequenceReader::hash() const {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.is_regular_file()) {
      names.insert(entry.path().lexically_relative(folder_).generic_string());
    }
  }
  const std::string header = SequenceFiles{fs::path()}.Header().generic_string();
  Hash64 hash;
  for (const std::string& name : names) {
    hash.Add(name);
    if (name == header) {
      SequenceInfo info = info_;
      info.provenance = Json::object();
      hash.Add(SequenceInfoJson(info).dump());
    } else {
      hash.AddFile(folder_ / name);
    }
  }
  return hash.Hex();
}

void VerifySequence(const fs::path& folder) {
  const SequenceReader reader(folder);
  Progress progress("verify " + folder.string(), reader.info().frames);
  for (int frame = 0; frame < reader.info().frames; ++frame) {
    reader.ReadDepth(frame);
    if (reader.info().surface) reader.ReadTrueVertices(frame);
    if (reader.info().own_surfaces) reader.ReadTrueSurface(frame);
    for (std::size_t view = 0; view < reader.info().views.size(); ++view)
      reader.ReadViewDepth(static_cast<int>(view), frame);
    progress.Advance();
  }
}

}  // namespace vitruvia
