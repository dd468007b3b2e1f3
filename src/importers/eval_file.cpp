#include "importers/eval_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <fstream>
#include <set>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "EVAL files are little-endian");

constexpr std::size_t kPointsAt = 8;
constexpr std::size_t kPointBytes = 3 * sizeof(float);
constexpr std::size_t kMarkersAt = kPointsAt + kEvalWidth * kEvalHeight * kPointBytes;
constexpr std::size_t kMarkerBytes = kEvalNameBytes + kPointBytes;
constexpr std::size_t kJointsAt = kMarkersAt + sizeof(int) + kEvalEntries * kMarkerBytes;
constexpr std::size_t kJointBytes = sizeof(int) + kPointBytes;
static_assert(kJointsAt + sizeof(int) + kEvalEntries * kJointBytes == kEvalFrameBytes);

// The bytes of one frame, and where they are, for messages.
class EvalBytes {
 public:
  EvalBytes(const fs::path& file, int frame)
      : file_(file), frame_(frame), bytes_(kEvalFrameBytes, '\0') {
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(frame) * static_cast<std::streamoff>(kEvalFrameBytes));
    stream.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    if (!stream) throw DataError(fmt::format("{}: frame {} cannot be read", file.string(), frame));
  }

  int Integer(std::size_t at) const {
    int value = 0;
    std::memcpy(&value, bytes_.data() + at, sizeof(value));
    return value;
  }

  // As it stands in the file.
  Vector3f RawPoint(std::size_t at) const {
    Vector3f p;
    std::memcpy(p.data(), bytes_.data() + at, kPointBytes);
    return p;
  }

  // Finite, and turned into our camera frame.
  Vector3d Place(std::size_t at, const std::string& what) const {
    const Vector3f p = RawPoint(at);
    if (!p.allFinite()) RefusePoint(at, what, "three finite numbers");
    return {p.x(), -p.y(), -p.z()};
  }

  [[noreturn]] void RefusePoint(std::size_t at, const std::string& what,
                                const char* expected) const {
    const Vector3f p = RawPoint(at);
    Refuse(at,
           fmt::format("{}: expected {}, got ({}, {}, {})", what, expected, p.x(), p.y(), p.z()));
  }

  int Count(std::size_t at, const char* what) const {
    const int count = Integer(at);
    if (count < 0 || count > kEvalEntries)
      Refuse(at, fmt::format("expected 0 … {} {}, got {}", kEvalEntries, what, count));
    return count;
  }

  std::string Name(std::size_t at) const {
    const std::string_view field(bytes_.data() + at, kEvalNameBytes);
    const std::string_view name = field.substr(0, field.find('\0'));
    const bool is_text = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return std::isprint(static_cast<unsigned char>(c)) != 0;
    });
    if (!is_text) Refuse(at, "expected the name of a marker in ASCII letters, got other bytes");
    return std::string(name);
  }

  [[noreturn]] void Refuse(std::size_t at, const std::string& problem) const {
    throw DataError(fmt::format("{}: frame {}, byte {}: {}", file_.string(), frame_,
                                static_cast<std::size_t>(frame_) * kEvalFrameBytes + at, problem));
  }

 private:
  const fs::path& file_;
  int frame_;
  std::string bytes_;
};

std::vector<Vector3f> ReadPoints(const EvalBytes& bytes) {
  std::vector<Vector3f> points;
  points.reserve(static_cast<std::size_t>(kEvalWidth) * kEvalHeight);
  for (int i = 0; i < kEvalWidth * kEvalHeight; ++i) {
    const std::size_t at = kPointsAt + static_cast<std::size_t>(i) * kPointBytes;
    const Vector3f p = bytes.RawPoint(at);
    const bool is_missing = p.isZero(0.0f);
    if (!p.allFinite() || !(is_missing || p.z() < 0.0f)) {
      bytes.RefusePoint(at, fmt::format("column {}, row {}", i % kEvalWidth, i / kEvalWidth),
                        "a point with z below 0, so before the camera, or (0, 0, 0)");
    }
    points.emplace_back(p.x(), -p.y(), -p.z());
  }
  return points;
}

std::map<std::string, Vector3d> ReadMarkers(const EvalBytes& bytes) {
  std::map<std::string, Vector3d> markers;
  std::set<std::string> names;
  const int count = bytes.Count(kMarkersAt, "markers");
  for (int i = 0; i < count; ++i) {
    const std::size_t at = kMarkersAt + sizeof(int) + static_cast<std::size_t>(i) * kMarkerBytes;
    const std::string name = bytes.Name(at);
    if (!names.insert(name).second)
      bytes.Refuse(at, fmt::format("expected each marker once, got \"{}\" twice", name));
    const Vector3d place = bytes.Place(at + kEvalNameBytes, "marker \"" + name + "\"");
    if (!place.isZero(0.0)) markers[name] = place;
  }
  return markers;
}

std::map<int, Vector3d> ReadJoints(const EvalBytes& bytes) {
  std::map<int, Vector3d> joints;
  std::set<int> ids;
  const int count = bytes.Count(kJointsAt, "joints");
  for (int i = 0; i < count; ++i) {
    const std::size_t at = kJointsAt + sizeof(int) + static_cast<std::size_t>(i) * kJointBytes;
    const int id = bytes.Integer(at);
    if (!ids.insert(id).second)
      bytes.Refuse(at, fmt::format("expected each joint once, got id {} twice", id));
    const Vector3d place = bytes.Place(at + sizeof(int), fmt::format("joint {}", id));
    if (!place.isZero(0.0)) joints[id] = place;
  }
  return joints;
}

}  // namespace

EvalFile::EvalFile(fs::path file) : file_(std::move(file)) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file_, error);
  if (error)
    throw DataError(fmt::format("{}: cannot be opened: {}", file_.string(), error.message()));
  if (size == 0 || size % kEvalFrameBytes != 0) {
    throw DataError(fmt::format(
        "{}: expected a whole number of frames of {} bytes, got {} bytes: {} frames and {} bytes",
        file_.string(), kEvalFrameBytes, size, size / kEvalFrameBytes, size % kEvalFrameBytes));
  }
  frames_ = static_cast<int>(size / kEvalFrameBytes);
  magic_ = EvalBytes(file_, 0).Integer(0);
}

EvalFrame EvalFile::ReadFrame(int frame) const {
  Require(frame >= 0 && frame < frames_, "EvalFile: frame {} of {}", frame, frames_);
  const EvalBytes bytes(file_, frame);
  if (bytes.Integer(0) != magic_) {
    bytes.Refuse(
        0, fmt::format("expected {:#010x} as at the beginning of the first frame, got "
                       "{:#010x}",
                       static_cast<unsigned>(magic_), static_cast<unsigned>(bytes.Integer(0))));
  }
  return {bytes.Integer(sizeof(int)), ReadPoints(bytes), ReadMarkers(bytes), ReadJoints(bytes)};
}

}  // namespace vitruvia
