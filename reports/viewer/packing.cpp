#include "reports/viewer/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <zlib.h>

#include "core/build_info.h"
#include "core/worker_team.h"
#include "reports/drawing/color_image.h"

namespace vitruvia {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

constexpr int kGridEnd = std::numeric_limits<std::uint16_t>::max();
constexpr int kChunkFrames = 32;  // a second: longer chunks are hardly smaller and open later
constexpr int kCompression = 4;   // of 1 … 9; 6 takes three times as long for 3 % less

constexpr const char* kCodingNames[] = {"plain", "byte_planes", "surface"};

template <class Number>
constexpr const char* TypeName() {
  if constexpr (std::is_floating_point_v<Number>) return "f32";
  return sizeof(Number) == 1 ? "u8" : sizeof(Number) == 2 ? "u16" : "u32";
}

template <class Number>
std::vector<std::uint8_t> AsBytes(std::span<const Number> values) {
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Small numbers of either sign become small numbers.
template <class Number>
Number ZigZag(Number difference) {
  const auto value = static_cast<std::make_signed_t<Number>>(difference);
  return static_cast<Number>((value << 1) ^ (value >> (8 * sizeof(Number) - 1)));
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

// The nearest whole number, halves upwards.
int RoundedQuotient(int sum, int count) {
  return static_cast<int>(std::floor((sum + 0.5 * count) / count));
}

// See Coding::kSurface; differences wrap round.
template <class Number>
std::vector<Number> SurfaceCoded(std::span<const Number> values, int frames,
                                 const EarlierNeighbours& neighbours) {
  const std::size_t vertices = neighbours.vertices();
  const std::size_t length = values.size() / static_cast<std::size_t>(std::max(frames, 1));
  const std::size_t parts = length / vertices;  // of a vertex
  std::vector<Number> coded(values.size());
  std::vector<int> change(length);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames); ++frame) {
    const std::size_t first = frame * length;
    for (std::size_t i = 0; i < length; ++i)
      change[i] = values[first + i] - (frame > 0 ? values[first + i - length] : 0);
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::span<const std::uint32_t> earlier = neighbours.Of(v);
      for (std::size_t part = 0; part < parts; ++part) {
        int expected = 0;
        for (const std::uint32_t n : earlier) expected += change[n * parts + part];
        if (earlier.size() > 1)
          expected = RoundedQuotient(expected, static_cast<int>(earlier.size()));
        coded[first + part * vertices + v] =
            ZigZag(static_cast<Number>(change[v * parts + part] - expected));
      }
    }
  }
  return coded;
}

// What is left of a surface repeats itself only in runs: looking for these alone is faster, and
// smaller than the usual search.
int StrategyFor(Coding coding) { return coding == Coding::kSurface ? Z_RLE : Z_DEFAULT_STRATEGY; }

std::vector<std::uint8_t> Compressed(std::vector<std::uint8_t> bytes, Coding coding) {
  constexpr int kWindowBits = 15, kMemory = 9;  // the largest
  z_stream stream{};
  if (deflateInit2(&stream, kCompression, Z_DEFLATED, kWindowBits, kMemory, StrategyFor(coding)) !=
      Z_OK) {
    throw std::runtime_error("zlib cannot compress an array");
  }
  std::vector<std::uint8_t> compressed(deflateBound(&stream, bytes.size()));
  stream.next_in = bytes.data();
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = compressed.data();
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int state = deflate(&stream, Z_FINISH);
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::runtime_error("zlib cannot compress an array");
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

EarlierNeighbours::EarlierNeighbours(const std::vector<Triangle>& triangles, std::size_t vertices) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;  // later, earlier
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = t[k], to = t[(k + 1) % 3];
      if (to < from) edges.emplace_back(from, to);
    }
  }
  std::ranges::sort(edges);
  begins_.push_back(0);
  auto edge = edges.begin();
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t before = indices_.size();
    for (; edge != edges.end() && static_cast<std::size_t>(edge->first) == v; ++edge)
      indices_.push_back(static_cast<std::uint32_t>(edge->second));
    if (v > 0 && indices_.size() == before) indices_.push_back(static_cast<std::uint32_t>(v - 1));
    begins_.push_back(static_cast<std::uint32_t>(indices_.size()));
  }
}

template <class Number, class Code>
nlohmann::json PackedArrays::Add(const std::vector<Number>& values, int frames, int chunk_frames,
                                 Coding coding, const Code& coded) {
  const std::size_t length = frames == 0 ? 0 : values.size() / static_cast<std::size_t>(frames);
  const nlohmann::json about = {{"id", elements_.size()},
                                {"type", TypeName<Number>()},
                                {"coding", kCodingNames[static_cast<int>(coding)]},
                                {"frames", frames},
                                {"chunk_frames", chunk_frames},
                                {"length", length}};
  for (int begin = 0; begin == 0 || begin < frames; begin += chunk_frames) {
    const int count = std::min(chunk_frames, frames - begin);
    const std::span<const Number> chunk = std::span(values).subspan(
        static_cast<std::size_t>(begin) * length, static_cast<std::size_t>(count) * length);
    elements_.push_back({coded(chunk, count), coding});
  }
  return about;
}

nlohmann::json PackedArrays::Bytes(const std::vector<std::uint8_t>& values) {
  return Add(values, 1, 1, Coding::kPlain,
             [](std::span<const std::uint8_t> chunk, int) { return AsBytes(chunk); });
}

nlohmann::json PackedArrays::Words(const std::vector<std::uint16_t>& values, int frames) {
  return Add(
      values, frames, kChunkFrames, Coding::kBytePlanes,
      [](std::span<const std::uint16_t> chunk, int count) { return InBytePlanes(chunk, count); });
}

nlohmann::json PackedArrays::Floats(const std::vector<float>& values, int frames) {
  return Add(values, frames, std::max(frames, 1), Coding::kPlain,
             [](std::span<const float> chunk, int) { return AsBytes(chunk); });
}

PackedSurface PackedArrays::Surface(const std::vector<Triangle>& triangles, std::size_t vertices) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (const std::int32_t corner : t) indices.push_back(static_cast<std::uint32_t>(corner));
  }
  return {Add(indices, 1, 1, Coding::kPlain,
              [](std::span<const std::uint32_t> chunk, int) { return AsBytes(chunk); }),
          EarlierNeighbours(triangles, vertices)};
}

template <class Number>
nlohmann::json PackedArrays::AddOn(const PackedSurface& surface, const std::vector<Number>& values,
                                   int frames) {
  nlohmann::json about = Add(values, frames, kChunkFrames, Coding::kSurface,
                             [&](std::span<const Number> chunk, int count) {
                               const std::vector<Number> coded =
                                   SurfaceCoded(chunk, count, surface.neighbours);
                               if constexpr (sizeof(Number) == 2) return InBytePlanes(coded, count);
                               return AsBytes(std::span<const Number>(coded));
                             });
  about["surface"] = surface.triangles.at("id");
  about["vertices"] = surface.neighbours.vertices();
  return about;
}

nlohmann::json PackedArrays::On(const PackedSurface& surface,
                                const std::vector<std::uint8_t>& values, int frames) {
  return AddOn(surface, values, frames);
}

nlohmann::json PackedArrays::On(const PackedSurface& surface,
                                const std::vector<std::uint16_t>& values, int frames) {
  return AddOn(surface, values, frames);
}

std::string PackedArrays::Html() const {
  std::vector<std::string> elements(elements_.size());
  WorkerTeam team(GetMachineInfo().threads);
  team.For(static_cast<int>(elements_.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto& [bytes, coding] = elements_[static_cast<std::size_t>(i)];
      elements[static_cast<std::size_t>(i)] = "<script type=\"text/plain\" id=\"array-" +
                                              std::to_string(i) + "\">" +
                                              InBase64(Compressed(bytes, coding)) + "</script>\n";
    }
  });
  std::string html;
  for (const std::string& element : elements) html += element;
  return html;
}

}  // namespace vitruvia
