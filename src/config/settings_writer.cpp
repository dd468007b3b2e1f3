#include <utility>

#include "config/json_settings.h"

namespace vitruvia {
namespace {

class Writer final : public Fields {
 public:
  Writer() { levels_.push_back(nlohmann::json::object()); }
  nlohmann::json Take() { return std::move(levels_.back()); }

  void Number(const char* key, double& value, const About&) override { Put(key, value); }
  void Integer(const char* key, int& value, const About&) override { Put(key, value); }
  void Flag(const char* key, bool& value, const About&) override { Put(key, value); }
  void Text(const char* key, std::string& value, const About&) override { Put(key, value); }
  void File(const char* key, std::filesystem::path& value, const About&) override {
    Put(key, value.string());
  }
  void Numbers(const char* key, std::span<double> values, const About&) override {
    Put(key, std::vector<double>(values.begin(), values.end()));
  }
  void FreeJson(const char* key, nlohmann::json& value, const About&) override { Put(key, value); }
  void Texts(const char* key, std::vector<std::string>& values, const About&) override {
    Put(key, values);
  }
  void Files(const char* key, std::vector<std::filesystem::path>& values, const About&) override {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const auto& value : values) texts.push_back(value.string());
    Put(key, texts);
  }
  void Integers(const char* key, std::vector<int>& values, const About&) override {
    Put(key, values);
  }

 protected:
  void ChoiceIndex(const char* key, std::size_t& index, std::span<const char* const> names,
                   const About&) override {
    Put(key, names[index]);
  }
  bool BeginSection(const char* key, const About&) override {
    keys_.emplace_back(key);
    levels_.push_back(nlohmann::json::object());
    return true;
  }
  void EndSection() override {
    nlohmann::json section = std::move(levels_.back());
    levels_.pop_back();
    Put(keys_.back().c_str(), std::move(section));
    keys_.pop_back();
  }
  bool BeginList(const char* key, std::size_t&, const About&) override {
    Put(key, nlohmann::json::array());
    keys_.emplace_back(key);
    return true;
  }
  void BeginItem(std::size_t) override { levels_.push_back(nlohmann::json::object()); }
  void EndItem() override {
    nlohmann::json item = std::move(levels_.back());
    levels_.pop_back();
    levels_.back()[keys_.back()].push_back(std::move(item));
  }
  void EndList() override { keys_.pop_back(); }

 private:
  template <class Value>
  void Put(const char* key, Value&& value) {
    levels_.back()[key] = std::forward<Value>(value);
  }

  std::vector<nlohmann::json> levels_;
  std::vector<std::string> keys_;
};

}  // namespace

namespace internal {

Json WriteSettingsWith(void* settings, void (*visit)(Fields&, void*)) {
  Writer writer;
  visit(writer, settings);
  return writer.Take();
}

}  // namespace internal
}  // namespace vitruvia
