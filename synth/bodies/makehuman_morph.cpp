#include "synth/bodies/makehuman_morph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.h"

namespace vitruvia {
namespace {

constexpr double kRaceShare = 1.0 / 3.0;

// MakeHuman's ages: a baby of 1 year, a child of 12, a young adult of 25, an old one of 90. Below
// 0.5 the slider blends the first three, above it the last two.
constexpr double kYoungFromAge = 0.1875, kYoungSlope = 3.2, kChildSlope = 16.0 / 3.0;

double BabyFactor(double age) { return std::max(0.0, 1.0 - kChildSlope * age); }
double YoungFactor(double age) {
  return age < 0.5 ? std::max(0.0, kYoungSlope * (age - kYoungFromAge)) : 2.0 - 2.0 * age;
}
double ChildFactor(double age) {
  if (age >= 0.5) return 0.0;
  return std::max(0.0, std::min(1.0, kChildSlope * age) - YoungFactor(age));
}
double OldFactor(double age) { return std::max(0.0, 2.0 * age - 1.0); }

// The three stops of a slider.
double AtMin(double x) { return std::max(0.0, 1.0 - 2.0 * x); }
double AtAverage(double x) { return 1.0 - std::abs(2.0 * x - 1.0); }
double AtMax(double x) { return std::max(0.0, 2.0 * x - 1.0); }

std::optional<double> StopFactor(std::string_view word, std::string_view category, double x) {
  if (!word.ends_with(category)) return {};
  const std::string_view stop = word.substr(0, word.size() - category.size());
  if (stop == "min") return AtMin(x);
  if (stop == "average") return AtAverage(x);
  if (stop == "max") return AtMax(x);
  return {};
}

// The factor of one word of a target's name; none for words that are no category.
std::optional<double> WordFactor(std::string_view word, const MakeHumanSliders& sliders) {
  if (word == "universal") return 1.0;
  if (word == "african" || word == "asian" || word == "caucasian") return kRaceShare;
  if (word == "male") return sliders.gender;
  if (word == "female") return 1.0 - sliders.gender;
  if (word == "baby") return BabyFactor(sliders.age);
  if (word == "child") return ChildFactor(sliders.age);
  if (word == "young") return YoungFactor(sliders.age);
  if (word == "old") return OldFactor(sliders.age);
  if (word == "uncommonproportions") return AtMin(sliders.proportions);
  if (word == "regularproportions") return AtAverage(sliders.proportions);
  if (word == "idealproportions") return AtMax(sliders.proportions);
  for (const auto& [category, x] :
       {std::pair{"muscle", sliders.muscle}, std::pair{"weight", sliders.weight},
        std::pair{"height", sliders.height}, std::pair{"cup", sliders.cup},
        std::pair{"firmness", sliders.firmness}}) {
    if (const auto factor = StopFactor(word, category, x)) return factor;
  }
  return {};
}

// The product of all words' factors; none if a word is no category.
std::optional<double> NameFactor(std::string_view name, const MakeHumanSliders& sliders) {
  constexpr std::string_view kRoot = "data/targets/", kSuffix = ".target";
  if (!name.starts_with(kRoot) || !name.ends_with(kSuffix)) return {};
  name.remove_prefix(kRoot.size());
  name.remove_suffix(kSuffix.size());
  if (!name.starts_with("macrodetails/") && !name.starts_with("breast/")) return {};
  std::string_view words = name.substr(name.rfind('/') + 1);
  double product = 1.0;
  while (true) {
    const std::size_t dash = words.find('-');
    const auto factor = WordFactor(words.substr(0, dash), sliders);
    if (!factor) return {};
    product *= *factor;
    if (dash == std::string_view::npos) return product;
    words.remove_prefix(dash + 1);
  }
}

}  // namespace

double MakeHumanAge(double years) {
  constexpr double kYoungest = 1.0, kYoung = 25.0, kOldest = 90.0;
  Require(years >= kYoungest && years <= kOldest, "age {} years, expected {} … {}", years,
          kYoungest, kOldest);
  return years < kYoung ? 0.5 * (years - kYoungest) / (kYoung - kYoungest)
                        : 0.5 + 0.5 * (years - kYoung) / (kOldest - kYoung);
}

double MakeHumanTargetWeight(const std::string& target_name, const MakeHumanSliders& sliders) {
  return NameFactor(target_name, sliders).value_or(0.0);
}

MakeHumanMorph::MakeHumanMorph(MakeHumanPackage package) : package_(std::move(package)) {
  for (std::size_t i = 0; i < package_.target_names.size(); ++i) {
    if (NameFactor(package_.target_names[i], {})) driven_targets_.push_back(static_cast<int>(i));
  }
}

std::vector<Vector3f> MakeHumanMorph::Vertices(const MakeHumanSliders& sliders) {
  std::vector<Vector3f> vertices = package_.vertices;
  for (const int target : driven_targets_) {
    const auto weight = static_cast<float>(
        MakeHumanTargetWeight(package_.target_names[static_cast<std::size_t>(target)], sliders));
    if (weight == 0.0f) continue;
    auto& displacements = displacements_[target];
    if (displacements.empty()) displacements = ReadMakeHumanTarget(package_, target);
    for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] += weight * displacements[v];
  }
  return vertices;
}

}  // namespace vitruvia
