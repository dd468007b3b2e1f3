#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.h"
#include "geometry/mesh_formats.h"
#include "geometry/text_lines.h"

namespace vitruvia {
namespace {

using Words = std::vector<std::string_view>;

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct Property {
  std::string name;
  Type type = Type::kFloat32;        // of the value, or of a list's items
  std::optional<Type> count_type{};  // of a list's length; a single value has none
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;

  // Index of the property of one of these names, -1 if there is none.
  int Find(std::initializer_list<std::string_view> names) const {
    for (std::size_t p = 0; p < properties.size(); ++p) {
      if (std::find(names.begin(), names.end(), properties[p].name) != names.end())
        return static_cast<int>(p);
    }
    return -1;
  }
};

enum class Storage { kText, kLittleEndian, kBigEndian };

struct Header {
  Storage storage = Storage::kText;
  std::vector<Element> elements;
};

Type TypeOf(std::string_view name, const TextLines& lines) {
  constexpr std::pair<std::string_view, Type> kNames[] = {
      {"char", Type::kInt8},      {"int8", Type::kInt8},       {"uchar", Type::kUint8},
      {"uint8", Type::kUint8},    {"short", Type::kInt16},     {"int16", Type::kInt16},
      {"ushort", Type::kUint16},  {"uint16", Type::kUint16},   {"int", Type::kInt32},
      {"int32", Type::kInt32},    {"uint", Type::kUint32},     {"uint32", Type::kUint32},
      {"float", Type::kFloat32},  {"float32", Type::kFloat32}, {"double", Type::kFloat64},
      {"float64", Type::kFloat64}};
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
  }
  lines.Fail(fmt::format("unknown type '{}'", name));
}

Storage StorageOf(const Words& words, const TextLines& lines) {
  if (words.size() == 3 && words[2] == "1.0") {
    if (words[1] == "ascii") return Storage::kText;
    if (words[1] == "binary_little_endian") return Storage::kLittleEndian;
    if (words[1] == "binary_big_endian") return Storage::kBigEndian;
  }
  lines.Fail(
      "expected 'format ascii 1.0', 'format binary_little_endian 1.0' or 'format "
      "binary_big_endian 1.0'");
}

Element ElementOf(const Words& words, const TextLines& lines) {
  const auto count = words.size() == 3 ? ParseInteger(words[2]) : std::nullopt;
  if (!count || *count < 0) lines.Fail("expected 'element', a name and a count");
  return {std::string(words[1]), *count, {}};
}

Property PropertyOf(const Words& words, const TextLines& lines) {
  if (words.size() == 3) return {std::string(words[2]), TypeOf(words[1], lines)};
  if (words.size() == 5 && words[1] == "list") {
    return {std::string(words[4]), TypeOf(words[3], lines), TypeOf(words[2], lines)};
  }
  lines.Fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
}

// Leaves `lines` at the line that ends the header.
Header ReadHeader(TextLines& lines) {
  if (!lines.Next() || lines.Words() != Words{"ply"}) {
    lines.Fail("is no PLY file: it does not begin with a line 'ply'");
  }
  Header header;
  bool has_format = false;
  while (lines.Next()) {
    const Words words = lines.Words();
    const std::string_view keyword = words.empty() ? "comment" : words[0];
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") {
      if (!has_format) lines.Fail("the header ends without a line 'format'");
      return header;
    }
    if (keyword == "format") {
      header.storage = StorageOf(words, lines);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(ElementOf(words, lines));
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.Fail("a property before the first element");
      Element& element = header.elements.back();
      const Property property = PropertyOf(words, lines);
      if (element.Find({property.name}) >= 0) {
        lines.Fail(fmt::format("property '{}' appears twice", property.name));
      }
      element.properties.push_back(property);
    } else {
      lines.Fail(fmt::format("unknown header line '{}'", keyword));
    }
  }
  lines.Fail("cut short within the header");
}

// The values after the header, one after the other. All types of PLY fit a double.
class Values {
 public:
  virtual ~Values() = default;
  virtual void Begin() = 0;  // an element
  virtual double Next(Type type) = 0;
  virtual void End() = 0;  // the element
  virtual void Finish() = 0;
  [[noreturn]] virtual void Fail(const std::string& problem) const = 0;
};

class TextValues final : public Values {
 public:
  explicit TextValues(TextLines& lines) : lines_(lines) {}

  void Begin() override {
    next_ = 0;
    do {
      if (!lines_.Next()) Fail("cut short: the file ends before all elements are read");
      words_ = lines_.Words();
    } while (words_.empty());
  }
  double Next(Type) override {
    if (next_ == words_.size()) {
      Fail(fmt::format("a line of {} values, expected more", words_.size()));
    }
    const std::string_view word = words_[next_++];
    const auto number = ParseNumber(word);
    if (!number) Fail(fmt::format("expected a number, got '{}'", word));
    return *number;
  }
  void End() override {
    if (next_ == words_.size()) return;
    Fail(fmt::format("a line of {} values, expected {}", words_.size(), next_));
  }
  void Finish() override {
    while (lines_.Next()) {
      if (!lines_.Words().empty()) Fail("expected the end of the file after the last element");
    }
  }
  [[noreturn]] void Fail(const std::string& problem) const override { lines_.Fail(problem); }

 private:
  TextLines& lines_;
  Words words_;
  std::size_t next_ = 0;
};

class BinaryValues final : public Values {
 public:
  BinaryValues(std::string_view content, std::size_t begin, Storage storage, std::string file)
      : content_(content),
        at_(begin),
        swapped_((storage == Storage::kBigEndian) != (std::endian::native == std::endian::big)),
        file_(std::move(file)) {}

  void Begin() override {}
  double Next(Type type) override {
    switch (type) {
      case Type::kInt8:
        return Take<std::int8_t>();
      case Type::kUint8:
        return Take<std::uint8_t>();
      case Type::kInt16:
        return Take<std::int16_t>();
      case Type::kUint16:
        return Take<std::uint16_t>();
      case Type::kInt32:
        return Take<std::int32_t>();
      case Type::kUint32:
        return Take<std::uint32_t>();
      case Type::kFloat32:
        return Take<float>();
      case Type::kFloat64:
        break;
    }
    return Take<double>();
  }
  void End() override {}
  void Finish() override {
    if (at_ == content_.size()) return;
    Fail(fmt::format("{} bytes follow the last element, expected none", content_.size() - at_));
  }
  [[noreturn]] void Fail(const std::string& problem) const override {
    throw DataError(fmt::format("{}: byte {}: {}", file_, at_, problem));
  }

 private:
  template <class Number>
  double Take() {
    char bytes[sizeof(Number)];
    if (content_.size() - at_ < sizeof(bytes)) {
      Fail("cut short: the file ends before all elements are read");
    }
    std::memcpy(bytes, content_.data() + at_, sizeof(bytes));
    at_ += sizeof(bytes);
    if (swapped_) std::reverse(std::begin(bytes), std::end(bytes));
    return std::bit_cast<Number>(bytes);
  }

  std::string_view content_;
  std::size_t at_;
  bool swapped_;
  std::string file_;
};

// One element: the values of each property, of which only a list may have other than one.
using Row = std::vector<std::vector<double>>;

void ReadRow(const Element& element, Values& values, Row& row) {
  row.resize(element.properties.size());
  values.Begin();
  for (std::size_t p = 0; p < row.size(); ++p) {
    const Property& property = element.properties[p];
    row[p].clear();
    const double count = property.count_type ? values.Next(*property.count_type) : 1.0;
    if (!(count >= 0.0 && count == std::floor(count))) {
      values.Fail(fmt::format("a list '{}' of {} items", property.name, count));
    }
    for (double i = 0.0; i < count; ++i) row[p].push_back(values.Next(property.type));
  }
  values.End();
}

std::int32_t IndexOf(double value, const Values& values) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (value != std::floor(value) || !(value >= Limits::min() && value <= Limits::max())) {
    values.Fail(fmt::format("expected a vertex of a face, got {}", value));
  }
  return static_cast<std::int32_t>(value);
}

void ReadVertices(const Element& element, Values& values, TriangleMesh& mesh) {
  std::array<std::size_t, 3> axes;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view name = std::array{"x", "y", "z"}[k];
    const int p = element.Find({name});
    if (p < 0 || element.properties[static_cast<std::size_t>(p)].count_type) {
      values.Fail(fmt::format("the vertices have no number '{}'", name));
    }
    axes[k] = static_cast<std::size_t>(p);
  }
  Row row;
  for (std::int64_t v = 0; v < element.count; ++v) {
    ReadRow(element, values, row);
    mesh.vertices.push_back(
        Vector3d(row[axes[0]][0], row[axes[1]][0], row[axes[2]][0]).cast<float>());
  }
}

void ReadFaces(const Element& element, Values& values, TriangleMesh& mesh) {
  const int corners = element.Find({"vertex_indices", "vertex_index"});
  if (corners < 0 || !element.properties[static_cast<std::size_t>(corners)].count_type) {
    values.Fail("the faces have no list 'vertex_indices'");
  }
  Row row;
  for (std::int64_t f = 0; f < element.count; ++f) {
    ReadRow(element, values, row);
    const std::vector<double>& face = row[static_cast<std::size_t>(corners)];
    if (face.size() != 3) {
      values.Fail(
          fmt::format("face {} has {} corners, expected 3 (triangulate the mesh)", f, face.size()));
    }
    mesh.triangles.push_back(
        {IndexOf(face[0], values), IndexOf(face[1], values), IndexOf(face[2], values)});
  }
}

void SkipElements(const Element& element, Values& values) {
  Row row;
  for (std::int64_t i = 0; i < element.count; ++i) ReadRow(element, values, row);
}

void RequireOneOfEach(const Header& header, const Values& values) {
  for (const std::string_view name : {"vertex", "face"}) {
    const auto count = std::count_if(header.elements.begin(), header.elements.end(),
                                     [&](const Element& element) { return element.name == name; });
    if (count != 1) {
      values.Fail(fmt::format("the header has {} elements '{}', expected one", count, name));
    }
  }
  for (const Element& element : header.elements) {
    if (element.count > 0 && element.properties.empty()) {
      values.Fail(fmt::format("element '{}' has no properties", element.name));
    }
  }
}

}  // namespace

TriangleMesh ParsePly(std::string_view content, const std::string& file) {
  TextLines lines(content, file);
  const Header header = ReadHeader(lines);
  std::unique_ptr<Values> values;
  if (header.storage == Storage::kText) {
    values = std::make_unique<TextValues>(lines);
  } else {
    values = std::make_unique<BinaryValues>(content, lines.position(), header.storage, file);
  }
  RequireOneOfEach(header, *values);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      ReadVertices(element, *values, mesh);
    } else if (element.name == "face") {
      ReadFaces(element, *values, mesh);
    } else {
      SkipElements(element, *values);
    }
  }
  values->Finish();
  return mesh;
}

}  // namespace vitruvia
