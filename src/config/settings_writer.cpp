#include <cmath>
#include <utility>

#include "config/json_settings.h"
#include "config/settings_text.h"
#include "core/error.h"

namespace vitruvia {
namespace {

using OrderedJson = nlohmann::ordered_json;

class Writer final : public Fields {
 public:
  Writer() { levels_.push_back(OrderedJson::object()); }
  OrderedJson Take() { return std::move(levels_.back()); }

  void Number(const char* key, double& value, const About& about) override {
    if (about.optional && std::isnan(value)) return;
    Put(key, Checked(key, value, about));
  }
  void Integer(const char* key, int& value, const About&) override { Put(key, value); }
  void Flag(const char* key, bool& value, const About&) override { Put(key, value); }
  void Text(const char* key, std::string& value, const About& about) override {
    if (about.optional && value.empty()) return;
    Put(key, value);
  }
  void File(const char* key, std::filesystem::path& value, const About&) override {
    Put(key, value.string());
  }
  void Numbers(const char* key, std::span<double> values, const About& about) override {
    Put(key, CheckedList(key, values, about));
  }
  void FreeJson(const char* key, nlohmann::json& value, const About& about) override {
    if (about.optional && value.empty()) return;
    Put(key, CheckedFree(key, value, about));
  }
  void Texts(const char* key, std::vector<std::string>& values, const About& about) override {
    PutList(key, values, about);
  }
  void Files(const char* key, std::vector<std::filesystem::path>& values,
             const About& about) override {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const auto& value : values) texts.push_back(value.string());
    PutList(key, texts, about);
  }
  void Integers(const char* key, std::vector<int>& values, const About& about) override {
    PutList(key, values, about);
  }
  void NumberList(const char* key, std::vector<double>& values, const About& about) override {
    if (about.optional && values.empty()) return;
    Put(key, CheckedList(key, values, about));
  }
  void Flags(const char* key, std::vector<bool>& values, const About& about) override {
    PutList(key, values, about);
  }

 protected:
  void NamesAndNumbers(const char* key, NameAndNumberList& values, const About& about) override {
    if (about.optional && values.empty()) return;
    OrderedJson pairs = OrderedJson::array();
    for (const auto& [name, value] : values) {
      const OrderedJson number = Checked(JoinedPath(key, name), value, about);
      pairs.push_back(OrderedJson::array({name, number}));
    }
    Put(key, std::move(pairs));
  }
  void Triples(const char* key, std::vector<double>& coordinates, const About& about) override {
    if (about.optional && coordinates.empty()) return;
    OrderedJson points = OrderedJson::array();
    for (std::size_t i = 0; i < coordinates.size(); i += 3) {
      const std::span<double> point(coordinates.data() + i, 3);
      if (about.null_items && std::isnan(point[0])) {
        points.push_back(nullptr);
      } else {
        points.push_back(CheckedList(key, point, {}));
      }
    }
    Put(key, std::move(points));
  }
  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About&) override {
    Put(key, names[index]);
  }
  bool BeginSection(const char* key, const About&) override {
    keys_.emplace_back(key);
    levels_.push_back(OrderedJson::object());
    return true;
  }
  void EndSection() override {
    OrderedJson section = std::move(levels_.back());
    levels_.pop_back();
    const std::string key = std::move(keys_.back());
    keys_.pop_back();
    Put(key.c_str(), std::move(section));
  }
  bool BeginMap(const char* key, std::vector<std::string>& names, const About& about) override {
    if (about.optional && names.empty()) return false;
    return BeginSection(key, about);
  }
  void EndMap() override { EndSection(); }
  bool BeginList(const char* key, std::size_t& count, const About& about) override {
    if (about.optional && count == 0) return false;
    keys_.emplace_back(key);
    lists_.push_back(OrderedJson::array());
    return true;
  }
  void BeginItem(std::size_t index) override {
    keys_.back() += fmt::format("[{}]", index);
    levels_.push_back(OrderedJson::object());
  }
  void EndItem() override {
    lists_.back().push_back(std::move(levels_.back()));
    levels_.pop_back();
    keys_.back().erase(keys_.back().rfind('['));
  }
  void EndList() override {
    OrderedJson list = std::move(lists_.back());
    lists_.pop_back();
    const std::string key = std::move(keys_.back());
    keys_.pop_back();
    Put(key.c_str(), std::move(list));
  }

 private:
  // A key occurs once in a description, so it need not be searched for.
  template <class Value>
  void Put(const char* key, Value&& value) {
    levels_.back().emplace(key, std::forward<Value>(value));
  }

  template <class Value>
  void PutList(const char* key, std::vector<Value>& values, const About& about) {
    if (!about.optional || !values.empty()) Put(key, values);
  }

  OrderedJson Checked(const std::string& key, double value, const About& about) const {
    if (std::isfinite(value)) return value;
    if (about.infinite && std::isinf(value))
      return value > 0.0 ? kInfinityText : kMinusInfinityText;
    std::string path;
    for (const std::string& above : keys_) path = JoinedPath(path, above);
    Require(false, "{} = {}: only finite numbers can be stored", JoinedPath(path, key), value);
    return nullptr;
  }

  OrderedJson CheckedList(const char* key, std::span<const double> values,
                          const About& about) const {
    OrderedJson list = OrderedJson::array();
    for (const double value : values) {
      const bool is_absent = about.null_items && std::isnan(value);
      list.push_back(is_absent ? OrderedJson(nullptr) : Checked(key, value, about));
    }
    return list;
  }

  OrderedJson CheckedFree(const std::string& key, const nlohmann::json& value,
                          const About& about) const {
    if (value.is_number_float()) return Checked(key, value.get<double>(), about);
    if (!value.is_structured()) return value;
    OrderedJson checked = value.is_array() ? OrderedJson::array() : OrderedJson::object();
    for (const auto& item : value.items()) {
      OrderedJson member = CheckedFree(JoinedPath(key, item.key()), item.value(), about);
      if (value.is_array()) {
        checked.push_back(std::move(member));
      } else {
        checked.emplace(item.key(), std::move(member));
      }
    }
    return checked;
  }

  std::vector<OrderedJson> levels_, lists_;
  std::vector<std::string> keys_;
};

}  // namespace

namespace internal {

OrderedJson WriteFields(void* value, void (*visit)(Fields&, void*)) {
  Writer writer;
  visit(writer, value);
  return writer.Take();
}

}  // namespace internal
}  // namespace vitruvia
