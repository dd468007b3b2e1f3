#include "importers/pcd_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "geometry/text_lines.h"

namespace vitruvia {
namespace {

constexpr std::size_t kLargestSide = 1 << 15;  // pixels

struct Field {
  std::string name;
  std::size_t size = 0, count = 1;
  char type = 'F';
  std::size_t Bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  std::size_t width = 0, height = 0;
  std::string data;       // ascii, binary or binary_compressed
  std::size_t begin = 0;  // of the points

  std::size_t Points() const { return width * height; }
  std::size_t Numbers() const {
    std::size_t numbers = 0;
    for (const Field& field : fields) numbers += field.count;
    return numbers;
  }
  std::size_t PointBytes() const {
    std::size_t bytes = 0;
    for (const Field& field : fields) bytes += field.Bytes();
    return bytes;
  }
};

std::size_t Count(std::string_view word, const TextLines& lines) {
  const auto value = ParseInteger(word);
  if (!value || *value < 0) lines.Fail(fmt::format("expected a count, got \"{}\"", word));
  return static_cast<std::size_t>(*value);
}

void ReadFieldLine(const std::vector<std::string_view>& words, const TextLines& lines,
                   Header& header) {
  const std::string_view key = words[0];
  if (key == "FIELDS") {
    for (std::size_t i = 1; i < words.size(); ++i) header.fields.push_back({std::string(words[i])});
    return;
  }
  if (words.size() != header.fields.size() + 1)
    lines.Fail(fmt::format("{}: expected {} words as FIELDS has, got {}", key, header.fields.size(),
                           words.size() - 1));
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    Field& field = header.fields[i];
    if (key == "SIZE") field.size = Count(words[i + 1], lines);
    if (key == "COUNT") field.count = Count(words[i + 1], lines);
    if (key == "TYPE") field.type = words[i + 1][0];
  }
}

Header ReadHeader(std::string_view content, const std::string& where) {
  TextLines lines(content, where);
  Header header;
  while (lines.Next()) {
    const std::vector<std::string_view> words = lines.Words();
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string_view key = words[0];
    if (key == "FIELDS" || key == "SIZE" || key == "TYPE" || key == "COUNT") {
      ReadFieldLine(words, lines, header);
    } else if ((key == "WIDTH" || key == "HEIGHT") && words.size() == 2) {
      (key == "WIDTH" ? header.width : header.height) = Count(words[1], lines);
    } else if (key == "DATA" && words.size() == 2) {
      header.data = words[1];
      header.begin = lines.position();
      return header;
    } else if (key != "VERSION" && key != "VIEWPOINT" && key != "POINTS") {
      lines.Fail(fmt::format("expected a line of a PCD header, got \"{}\"", key.substr(0, 40)));
    }
  }
  throw DataError(fmt::format("{}: expected a PCD header with a line DATA, found none", where));
}

void RequireOrganised(const Header& header, const std::string& where) {
  if (header.height < 2 || header.width < 2) {
    throw DataError(fmt::format(
        "{}: expected an organised cloud, a point for each pixel; found {}×{} points: the order of "
        "the pixels is lost",
        where, header.width, header.height));
  }
  if (header.width > kLargestSide || header.height > kLargestSide)
    throw DataError(
        fmt::format("{}: {}×{} points are no image", where, header.width, header.height));
}

// Of a field in a point: how many numbers, and how many bytes, stand before it.
struct Place {
  std::size_t numbers = 0, bytes = 0;
};

std::array<Place, 3> CoordinatePlaces(const Header& header, const std::string& where) {
  std::array<Place, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto field = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const Field& f) { return f.name == name; });
    if (field == header.fields.end())
      throw DataError(fmt::format("{}: expected the fields x, y and z, found no {}", where, name));
    if (field->size != 4 || field->type != 'F' || field->count != 1)
      throw DataError(
          fmt::format("{}: field {}: expected one number of 4 bytes, type F; found {} of "
                      "{} bytes, type {}",
                      where, name, field->count, field->size, field->type));
    for (auto before = header.fields.begin(); before != field; ++before) {
      places[axis].numbers += before->count;
      places[axis].bytes += before->Bytes();
    }
  }
  return places;
}

[[noreturn]] void FailShort(const std::string& where, std::size_t expected, std::size_t got) {
  throw DataError(
      fmt::format("{}: cut short: expected {} bytes of points, got {}", where, expected, got));
}

float FloatAt(const char* bytes) {
  float value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

void ReadBinary(std::string_view bytes, const Header& header, const std::array<Place, 3>& places,
                const std::string& where, std::vector<Vector3f>& points) {
  const std::size_t stride = header.PointBytes();
  if (bytes.size() < stride * header.Points())
    FailShort(where, stride * header.Points(), bytes.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      points[i][axis] =
          FloatAt(bytes.data() + i * stride + places[static_cast<std::size_t>(axis)].bytes);
  }
}

// LZF, as liblzf writes it: literal runs and back references. Empty if damaged.
std::string Decompressed(std::string_view packed, std::size_t size) {
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const unsigned control = byte();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (at + length > packed.size() || out.size() + length > size) return "";
      out.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) {
      if (at >= packed.size()) return "";
      length += byte();
    }
    if (at >= packed.size()) return "";
    const std::size_t back = ((control & 31U) << 8U) + byte() + 1;
    length += 2;
    if (back > out.size() || out.size() + length > size) return "";
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
  }
  return out.size() == size ? out : "";
}

// Compressed clouds are stored field by field: all x, then all y …
void ReadCompressed(std::string_view bytes, const Header& header,
                    const std::array<Place, 3>& places, const std::string& where,
                    std::vector<Vector3f>& points) {
  std::uint32_t packed = 0, size = 0;
  if (bytes.size() < 8) FailShort(where, 8, bytes.size());
  std::memcpy(&packed, bytes.data(), 4);
  std::memcpy(&size, bytes.data() + 4, 4);
  if (bytes.size() < 8 + std::size_t{packed})
    FailShort(where, 8 + std::size_t{packed}, bytes.size());
  const std::size_t expected = header.PointBytes() * header.Points();
  const std::string unpacked = size == expected ? Decompressed(bytes.substr(8, packed), size) : "";
  if (unpacked.empty())
    throw DataError(fmt::format("{}: damaged: its compressed points do not unpack to {} bytes",
                                where, expected));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char* column = unpacked.data() + places[axis].bytes * header.Points();
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i][static_cast<int>(axis)] = FloatAt(column + 4 * i);
  }
}

void ReadAscii(std::string_view text, const Header& header, const std::array<Place, 3>& places,
               const std::string& where, std::vector<Vector3f>& points) {
  TextLines lines(text, where + " (points)");
  for (Vector3f& point : points) {
    if (!lines.Next())
      throw DataError(
          fmt::format("{}: cut short: expected {} lines of points", where, points.size()));
    const std::vector<std::string_view> words = lines.Words();
    if (words.size() < header.Numbers())
      lines.Fail(fmt::format("expected {} numbers, got {}", header.Numbers(), words.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view word = words[places[axis].numbers];
      const auto value = ParseNumber(word);
      if (!value) lines.Fail(fmt::format("expected a number, got \"{}\"", word));
      point[static_cast<int>(axis)] = static_cast<float>(*value);
    }
  }
}

}  // namespace

OrganisedCloud ReadOrganisedPcd(const std::filesystem::path& file) {
  const std::string where = file.string();
  const std::string content = ReadWholeFile(file);
  const Header header = ReadHeader(content, where);
  RequireOrganised(header, where);
  const std::array<Place, 3> places = CoordinatePlaces(header, where);
  OrganisedCloud cloud{static_cast<int>(header.width), static_cast<int>(header.height),
                       std::vector<Vector3f>(header.Points())};
  const std::string_view points = std::string_view(content).substr(header.begin);
  if (header.data == "binary") {
    ReadBinary(points, header, places, where, cloud.points);
  } else if (header.data == "binary_compressed") {
    ReadCompressed(points, header, places, where, cloud.points);
  } else if (header.data == "ascii") {
    ReadAscii(points, header, places, where, cloud.points);
  } else {
    throw DataError(fmt::format("{}: DATA: expected ascii, binary or binary_compressed, got \"{}\"",
                                where, header.data));
  }
  return cloud;
}

}  // namespace vitruvia
