// Structs that describe themselves: settings, and the files of our own formats (stored_data.h).
//
// Such a struct has one member function `void Describe(Fields& fields)` that names each member
// once, with its meaning, unit, range and where its default comes from. The strict JSON reader, the
// writer, the JSON schema and `vitruvia explain` all walk that one description, so a default, a
// range and a unit stand in exactly one place. An optional member `std::string Problem() const`
// checks conditions that involve several fields ("" if there is no problem).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vitruvia {

// Where a default comes from.
enum class Origin {
  kPaper,    // printed in the paper that the field's source names
  kGuessed,  // the paper is silent; a reading of ours, not yet decided by a sweep
  kTuned,    // chosen by a measurement that the field's source names
  kInput,    // a fact about a scene or an experiment, given by the user
};
const char* Name(Origin origin);

struct About {
  const char* meaning = "";
  const char* unit = "";
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  Origin origin = Origin::kInput;
  const char* source = "";  // equation, section or measurement behind the default
  bool required = false;    // settings: the key must be present; there is no default
  // The rest is for stored data only, where every key that is not optional must be present (see
  // stored_data.h).
  bool optional = false;    // the key is left out of the file if there is no value: NaN, empty text
                            // or list
  bool null_items = false;  // items of a list may be absent: null in the file, NaN in memory
  bool infinite = false;    // numbers may be infinite: "Infinity" or "-Infinity" in the file
};

template <class Enum>
using Choices = std::initializer_list<std::pair<const char*, Enum>>;

// Visitor over the fields of a struct. Readers write through the references; writers and explainers
// only read them.
class Fields {
 public:
  virtual ~Fields() = default;

  virtual void Number(const char* key, double& value, const About& about) = 0;
  virtual void Integer(const char* key, int& value, const About& about) = 0;
  virtual void Flag(const char* key, bool& value, const About& about) = 0;
  virtual void Text(const char* key, std::string& value, const About& about) = 0;
  // A file or folder; relative ones are relative to the config file that holds them, and a leading
  // $NAME/ is an environment variable.
  virtual void File(const char* key, std::filesystem::path& value, const About& about) = 0;
  // Exactly N numbers.
  virtual void Numbers(const char* key, std::span<double> values, const About& about) = 0;
  // An unchecked JSON value, such as overrides that another reader checks later.
  virtual void FreeJson(const char* key, nlohmann::json& value, const About& about) = 0;
  virtual void Texts(const char* key, std::vector<std::string>& values, const About& about) = 0;
  virtual void Files(const char* key, std::vector<std::filesystem::path>& values,
                     const About& about) = 0;
  virtual void Integers(const char* key, std::vector<int>& values, const About& about) = 0;
  // Any number of numbers.
  virtual void NumberList(const char* key, std::vector<double>& values, const About& about) = 0;
  virtual void Flags(const char* key, std::vector<bool>& values, const About& about) = 0;

  // Named numbers in a given order, stored as [["name", 1.5], …] because a JSON object has no
  // order. `Named` has the members `name` and `value`.
  template <class Named>
  void NamedNumbers(const char* key, std::vector<Named>& values, const About& about) {
    NameAndNumberList pairs;
    for (const Named& named : values) pairs.emplace_back(named.name, named.value);
    NamesAndNumbers(key, pairs, about);
    values.clear();
    for (auto& [name, value] : pairs) values.push_back({std::move(name), value});
  }

  // Points: [[x, y, z], …]; with null_items, an absent point is null in the file and NaN in memory.
  // `Point` has a member data() that points to three doubles.
  template <class Point>
  void Points(const char* key, std::vector<Point>& points, const About& about) {
    std::vector<double> coordinates;
    coordinates.reserve(3 * points.size());
    for (const Point& point : points)
      coordinates.insert(coordinates.end(), point.data(), point.data() + 3);
    Triples(key, coordinates, about);
    points.resize(coordinates.size() / 3);
    for (std::size_t i = 0; i < points.size(); ++i)
      std::copy_n(coordinates.data() + 3 * i, 3, points[i].data());
  }

  // An object with arbitrary keys. Values: double, std::string or std::vector<double>. `about`
  // describes the object, and its range applies to each value.
  template <class Value>
  void Map(const char* key, std::map<std::string, Value>& values, const About& about) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values) names.push_back(name);
    if (!BeginMap(key, names, about)) return;
    for (const std::string& name : names) Entry(name.c_str(), values[name], about);
    EndMap();
  }

  template <class Enum>
  void Choice(const char* key, Enum& value, Choices<Enum> choices, const About& about) {
    std::vector<const char*> names;
    std::size_t index = 0;
    for (const auto& [name, candidate] : choices) {
      if (candidate == value) index = names.size();
      names.push_back(name);
    }
    ChoiceIndex(key, index, names, about);
    value = (choices.begin() + index)->second;
  }

  template <class Struct>
  void Section(const char* key, Struct& value, const About& about) {
    if (!BeginSection(key, about)) return;
    Visit(value);
    EndSection();
  }

  // Each item is read into a default-constructed struct.
  template <class Struct>
  void List(const char* key, std::vector<Struct>& values, const About& about) {
    std::size_t count = values.size();
    if (!BeginList(key, count, about)) return;
    values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      BeginItem(i);
      Visit(values[i]);
      EndItem();
    }
    EndList();
  }

  // Whether to visit fields that depend on an earlier choice; an explainer visits all of them.
  virtual bool Applies(bool condition) { return condition; }

  template <class Struct>
  void Visit(Struct& value) {
    value.Describe(*this);
    if constexpr (requires { value.Problem(); }) {
      if (WantsProblems()) ReportProblem(value.Problem());
    }
  }

 protected:
  using NameAndNumberList = std::vector<std::pair<std::string, double>>;
  virtual void NamesAndNumbers(const char* key, NameAndNumberList& values, const About& about) = 0;
  virtual void Triples(const char* key, std::vector<double>& coordinates, const About& about) = 0;
  // Readers fill in the names; explainers give one placeholder name.
  virtual bool BeginMap(const char* key, std::vector<std::string>& names, const About& about) = 0;
  virtual void EndMap() = 0;
  virtual void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                           const About& about) = 0;
  virtual bool BeginSection(const char* key, const About& about) = 0;
  virtual void EndSection() = 0;
  virtual bool BeginList(const char* key, std::size_t& count, const About& about) = 0;
  virtual void BeginItem(std::size_t index) = 0;
  virtual void EndItem() = 0;
  virtual void EndList() = 0;
  virtual bool WantsProblems() const { return false; }
  virtual void ReportProblem(const std::string& /*problem*/) {}

 private:
  void Entry(const char* key, double& value, const About& about) { Number(key, value, about); }
  void Entry(const char* key, std::string& value, const About& about) { Text(key, value, about); }
  void Entry(const char* key, std::vector<double>& values, const About& about) {
    NumberList(key, values, about);
  }
};

}  // namespace vitruvia
