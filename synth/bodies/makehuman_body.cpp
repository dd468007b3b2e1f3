#include "synth/bodies/makehuman_body.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "synth/bodies/makehuman_tpose.h"
#include "synth/bodies/mannequin.h"

namespace vitruvia {
namespace {

constexpr double kHeightTolerance_m = 1e-5;
constexpr double kWeightTolerance_kg = 1e-3;
constexpr int kMaxRootSteps = 60;

// A root of an increasing function on [0, 1] by the Illinois method (false position that halves
// the value of an end that stays); the nearer end if there is none.
template <class Function>
double FindRoot(const Function& f, double tolerance) {
  double low = 0.0, high = 1.0, at_low = f(low);
  if (at_low >= 0.0) return low;
  double at_high = f(high);
  if (at_high <= 0.0) return high;
  double x = high;
  int last_side = 0;
  for (int step = 0; step < kMaxRootSteps; ++step) {
    x = high - at_high * (high - low) / (at_high - at_low);
    const double at_x = f(x);
    if (std::abs(at_x) <= tolerance) break;
    const int side = at_x > 0.0 ? 1 : -1;
    (side > 0 ? high : low) = x;
    (side > 0 ? at_high : at_low) = at_x;
    if (side == last_side) (side > 0 ? at_low : at_high) *= 0.5;
    last_side = side;
  }
  return x;
}

double Height_m(const std::vector<Vector3f>& vertices_dm) {
  const auto [lowest, highest] =
      std::minmax_element(vertices_dm.begin(), vertices_dm.begin() + kMakeHumanBodyVertices,
                          [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); });
  return kMetresPerDecimetre * static_cast<double>(highest->y() - lowest->y());
}

// The height and weight sliders of a body of given height and weight.
class SliderSearch {
 public:
  SliderSearch(MakeHumanMorph& morph, const BodySettings& settings)
      : morph_(morph), settings_(settings), tpose_(morph.package()) {
    sliders_.gender = settings.sex == Sex::kMale ? 1.0 : 0.0;
    sliders_.age = MakeHumanAge(settings.age_years);
    sliders_.muscle = settings.muscle;
  }

  MakeHumanSliders Find() {
    sliders_.weight = FindRoot(
        [&](double slider) { return WeightAt(slider) - settings_.weight_kg; }, kWeightTolerance_kg);
    const double weight_kg = WeightAt(sliders_.weight);
    CheckHeight();
    if (std::abs(weight_kg - settings_.weight_kg) > 10.0 * kWeightTolerance_kg) {
      throw ConfigError(fmt::format(
          "body weight {} kg: no MakeHuman body {:.2f} m tall, {} weighs that; expected "
          "{:.1f} … {:.1f} kg (less muscle reaches further both ways)",
          settings_.weight_kg, settings_.height_m, Person(), WeightAt(0.0), WeightAt(1.0)));
    }
    return sliders_;
  }

 private:
  std::string Person() const {
    return fmt::format("{}, {} years old and of muscle {}",
                       settings_.sex == Sex::kMale ? "male" : "female", settings_.age_years,
                       settings_.muscle);
  }

  double HeightAt(double height_slider) {
    sliders_.height = height_slider;
    return Height_m(morph_.Vertices(sliders_));
  }

  // Weight of the T-posed body at that weight slider once it has the wanted height.
  double WeightAt(double weight_slider) {
    sliders_.weight = weight_slider;
    sliders_.height = FindRoot([&](double slider) { return HeightAt(slider) - settings_.height_m; },
                               kHeightTolerance_m);
    const QuadMesh body{tpose_.Apply(morph_.Vertices(sliders_)).body_vertices,
                        morph_.package().body_quads};
    return EnclosedVolume(Triangulated(body)) * BodyDensity(settings_.sex);
  }

  void CheckHeight() {
    const double height_m = HeightAt(sliders_.height);
    if (std::abs(height_m - settings_.height_m) <= 10.0 * kHeightTolerance_m) return;
    throw ConfigError(fmt::format(
        "body height {} m: no MakeHuman body, {}, is that tall; expected {:.2f} … {:.2f} m",
        settings_.height_m, Person(), HeightAt(0.0), HeightAt(1.0)));
  }

  MakeHumanMorph& morph_;
  const BodySettings& settings_;
  const MakeHumanTPose tpose_;
  MakeHumanSliders sliders_;
};

}  // namespace

MakeHumanMeasures Measure(const MakeHumanPackage& package, const std::vector<Vector3f>& vertices) {
  const QuadMesh body{{vertices.begin(), vertices.begin() + kMakeHumanBodyVertices},
                      package.body_quads};
  constexpr double kCubed = kMetresPerDecimetre * kMetresPerDecimetre * kMetresPerDecimetre;
  return {Height_m(vertices), kCubed * EnclosedVolume(Triangulated(body))};
}

MakeHumanBodies::MakeHumanBodies(const std::filesystem::path& folder)
    : morph_(MakeHumanPackage::Read(folder)),
      tpose_(morph_.package()),
      weights_(MergedWeights(morph_.package())),
      reference_(tpose_.Apply(morph_.package().vertices).body_vertices) {}

ControlBody MakeHumanBodies::Make(const MakeHumanSliders& sliders, Sex sex) {
  TPosedMakeHuman posed = tpose_.Apply(morph_.Vertices(sliders));
  ControlBody body;
  body.cage = {std::move(posed.body_vertices), morph_.package().body_quads};
  body.weights = Dense(weights_, kBoneCount);
  body.skeleton = posed.skeleton;
  const auto [lowest, highest] =
      std::minmax_element(body.cage.vertices.begin(), body.cage.vertices.end(),
                          [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); });
  body.attributes = {static_cast<double>(highest->y() - lowest->y()),
                     EnclosedVolume(Triangulated(body.cage)) * BodyDensity(sex), sex};
  body.name =
      fmt::format("makehuman, {}, {:.2f} m, {:.1f} kg", sex == Sex::kMale ? "male" : "female",
                  body.attributes.height_m, body.attributes.weight_kg);
  body.reference_vertices = reference_;
  return body;
}

ControlBody MakeMakeHumanBody(const BodySettings& settings) {
  MakeHumanMorph morph(MakeHumanPackage::Read(settings.makehuman_folder));
  const MakeHumanSliders sliders = SliderSearch(morph, settings).Find();
  ControlBody body = MakeHumanBodies(settings.makehuman_folder).Make(sliders, settings.sex);
  body.attributes = {settings.height_m, settings.weight_kg, settings.sex};
  return body;
}

}  // namespace vitruvia
