#include "reports/viewer/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <zlib.h>

#include "core/build_info.h"
#include "core/worker_team.h"
#include "reports/drawing/color_image.h"

namespace vitruvia {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

constexpr float kFinestStep_m = 1e-4f;
constexpr int kGridEnd = std::numeric_limits<std::uint16_t>::max();
constexpr int kChunkFrames = 32;  // a second: longer chunks are hardly smaller and open later
constexpr int kCompression = 4;   // of 1 … 9; 6 takes three times as long for 3 % less

constexpr const char* kCodingNames[] = {"plain", "byte_planes", "frame_changes", "motion"};

template <class Number>
std::vector<std::uint8_t> AsBytes(std::span<const Number> values) {
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Small numbers of either sign become small numbers.
std::uint16_t ZigZag(std::uint16_t difference) {
  const auto value = static_cast<std::int16_t>(difference);
  return static_cast<std::uint16_t>((value << 1) ^ (value >> 15));
}

std::vector<std::uint8_t> InBytePlanes(std::span<const std::uint16_t> values, int frames) {
  const std::size_t length = values.size() / static_cast<std::size_t>(std::max(frames, 1));
  std::vector<std::uint8_t> bytes(2 * values.size());
  for (int frame = 0; frame < frames; ++frame) {
    const std::uint16_t* from = values.data() + static_cast<std::size_t>(frame) * length;
    std::uint8_t* low = bytes.data() + 2 * static_cast<std::size_t>(frame) * length;
    std::uint8_t* high = low + length;
    for (std::size_t i = 0; i < length; ++i) {
      low[i] = static_cast<std::uint8_t>(from[i] & 0xff);
      high[i] = static_cast<std::uint8_t>(from[i] >> 8);
    }
  }
  return bytes;
}

// See Coding::kMotion; all sums wrap round at 16 bits.
std::vector<std::uint16_t> MotionCoded(std::span<const std::uint16_t> values, int frames) {
  const std::size_t length = values.size() / static_cast<std::size_t>(std::max(frames, 1));
  const std::size_t vertices = length / 3;
  std::vector<std::uint16_t> coded(values.size());
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames); ++frame) {
    const auto at = [&](std::size_t back, std::size_t i) {
      return frame < back ? 0 : values[(frame - back) * length + i];
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::uint16_t before = 0;
      for (std::size_t v = 0; v < vertices; ++v) {
        const std::size_t i = 3 * v + axis;
        const auto change = static_cast<std::uint16_t>(at(0, i) - 2 * at(1, i) + at(2, i));
        coded[frame * length + axis * vertices + v] =
            ZigZag(static_cast<std::uint16_t>(change - before));
        before = change;
      }
    }
  }
  return coded;
}

std::vector<std::uint8_t> FrameChanges(std::span<const std::uint8_t> values, int frames) {
  const std::size_t length = values.size() / static_cast<std::size_t>(std::max(frames, 1));
  std::vector<std::uint8_t> changes(values.begin(), values.end());
  for (std::size_t i = length; i < values.size(); ++i)
    changes[i] = static_cast<std::uint8_t>(values[i] - values[i - length]);
  return changes;
}

std::vector<std::uint8_t> Coded(std::span<const std::uint8_t> values, int frames, Coding coding) {
  return coding == Coding::kFrameChanges ? FrameChanges(values, frames) : AsBytes(values);
}
std::vector<std::uint8_t> Coded(std::span<const std::uint16_t> values, int frames, Coding coding) {
  if (coding == Coding::kPlain) return AsBytes(values);
  if (coding == Coding::kBytePlanes) return InBytePlanes(values, frames);
  return InBytePlanes(MotionCoded(values, frames), frames);
}
template <class Number>  // of 32 bits
std::vector<std::uint8_t> Coded(std::span<const Number> values, int /*frames*/, Coding /*plain*/) {
  return AsBytes(values);
}

std::vector<std::uint8_t> Compressed(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> compressed(size);
  if (compress2(compressed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                kCompression) != Z_OK) {
    throw std::runtime_error("zlib cannot compress an array");
  }
  compressed.resize(size);
  return compressed;
}

std::string InBase64(const std::vector<std::uint8_t>& bytes) {
  return Base64(bytes.data(), bytes.size());
}

}  // namespace

PositionGrid PositionGrid::Over(const Eigen::AlignedBox3f& box) {
  return {box.min(), std::max(kFinestStep_m, box.sizes().maxCoeff() / kGridEnd)};
}

std::vector<std::uint16_t> PositionGrid::Quantised(const std::vector<Vector3f>& points) const {
  std::vector<std::uint16_t> values;
  values.reserve(3 * points.size());
  for (const Vector3f& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const float cell = std::round((point[axis] - origin[axis]) / step_m);
      values.push_back(
          static_cast<std::uint16_t>(std::clamp(cell, 0.0f, static_cast<float>(kGridEnd))));
    }
  }
  return values;
}

template <class Number>
nlohmann::json PackedArrays::Add(const std::vector<Number>& values, const char* type, Coding coding,
                                 int frames, int chunk_frames) {
  const std::size_t length = frames == 0 ? 0 : values.size() / static_cast<std::size_t>(frames);
  const nlohmann::json about = {{"id", arrays_.size()},
                                {"type", type},
                                {"coding", kCodingNames[static_cast<int>(coding)]},
                                {"frames", frames},
                                {"chunk_frames", chunk_frames},
                                {"length", length}};
  for (int begin = 0; begin == 0 || begin < frames; begin += chunk_frames) {
    const int count = std::min(chunk_frames, frames - begin);
    const std::span<const Number> chunk = std::span(values).subspan(
        static_cast<std::size_t>(begin) * length, static_cast<std::size_t>(count) * length);
    arrays_.push_back(Coded(chunk, count, coding));
  }
  return about;
}

nlohmann::json PackedArrays::Bytes(const std::vector<std::uint8_t>& values, int frames,
                                   Coding coding) {
  return Add(values, "u8", coding, frames, kChunkFrames);
}

nlohmann::json PackedArrays::Words(const std::vector<std::uint16_t>& values, int frames,
                                   Coding coding) {
  return Add(values, "u16", coding, frames, kChunkFrames);
}

nlohmann::json PackedArrays::Indices(const std::vector<std::uint32_t>& values) {
  return Add(values, "u32", Coding::kPlain, 1, 1);
}

nlohmann::json PackedArrays::Floats(const std::vector<float>& values, int frames) {
  return Add(values, "f32", Coding::kPlain, frames, std::max(frames, 1));
}

std::string PackedArrays::Html() const {
  std::vector<std::string> elements(arrays_.size());
  WorkerTeam team(GetMachineInfo().threads);
  team.For(static_cast<int>(arrays_.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      elements[i] = "<script type=\"text/plain\" id=\"array-" + std::to_string(i) + "\">" +
                    InBase64(Compressed(arrays_[i])) + "</script>\n";
    }
  });
  std::string html;
  for (const std::string& element : elements) html += element;
  return html;
}

}  // namespace vitruvia
