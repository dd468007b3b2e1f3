// A seeded population: people of either body source, drawn from stated distributions.
#pragma once

#include <filesystem>
#include <memory>

#include "config/settings.h"
#include "core/random.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {

struct PopulationSettings {
  BodySource source = BodySource::kMannequin;
  int subjects = 400;
  int seed = 1;
  double male_share = 0.5;
  // Mannequins are asked for by height and weight; both normal within a sex.
  double body_mass_index = 26.0, body_mass_index_deviation = 4.0;  // kg/m²
  // MakeHuman bodies are asked for by their sliders, each normal round 0.5 and cut off at 0 and 1.
  std::filesystem::path makehuman_folder;
  double youngest_years = 18.0, oldest_years = 75.0;  // even between
  double height_slider_deviation = 0.09;
  double build_slider_deviation = 0.18;       // muscle, weight
  double proportion_slider_deviation = 0.15;  // proportions, cup, firmness

  void Describe(Fields& fields);
  std::string Problem() const;
};

class Population {
 public:
  struct Source;  // one kind of body

  // ConfigError or DataError if the source's files are missing or damaged.
  explicit Population(const PopulationSettings& settings);
  ~Population();

  // The subject of that number, independent of the order of calls. Its attributes are those of its
  // mesh: height of the surface, weight by volume and density.
  ControlBody Subject(int number);

 private:
  std::unique_ptr<Source> source_;
};

}  // namespace vitruvia
