#include "synth/scene/scene.h"

#include <cmath>

#include <fmt/format.h>

#include "math/angles.h"
#include "math/rigid.h"
#include "synth/scene/recording.h"

namespace vitruvia {
namespace {

constexpr double kStandingRoomM = 0.5;    // round the axis on which the subject first stands
constexpr double kSteepestSine = 0.9999;  // of the view's angle with the horizontal
constexpr double kShortestLookM = 1e-6;   // between camera and the point that it looks at

Vector3d ToVector(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace

void TruthSettings::Describe(Fields& f) {
  f.Choice("skinning", skinning,
           {{"linear", Skinning::kLinear}, {"dual_quaternion", Skinning::kDualQuaternion}},
           {.meaning = "how the true surface follows its bones: linear blend (paper A, eq. 2a) or "
                       "dual quaternions (paper B, eqs. 3 and 4)"});
  f.Visit(refinement);
  f.Section("cloth", cloth,
            {.meaning = "clothes and differences of volume that the template does not have"});
}

void ViewSettings::Describe(Fields& f) {
  f.Section("camera", camera, {.meaning = "intrinsics"});
  f.Numbers("position_m", position_m,
            {.meaning = "position of the camera: x to the subject's left, y up, z to the front, "
                        "from the floor under the subject's start",
             .unit = "m",
             .min = -20.0,
             .max = 20.0});
  f.Numbers("look_at_m", look_at_m,
            {.meaning = "the point in the middle of the view, same axes",
             .unit = "m",
             .min = -20.0,
             .max = 20.0});
  f.Number(
      "roll_deg", roll_deg,
      {.meaning = "rotation of the camera about its line of sight, clockwise as seen by the camera",
       .unit = "deg",
       .min = -360.0,
       .max = 360.0});
}

std::string ViewSettings::Problem() const {
  const Vector3d look = ToVector(look_at_m) - ToVector(position_m);
  if (look.norm() < kShortestLookM) return "position_m and look_at_m are the same point";
  if (std::abs(look.normalized().y()) > kSteepestSine) {
    return "the camera looks straight up or down, so its upright is undefined; move position_m or "
           "look_at_m sideways";
  }
  return "";
}

Rigidd CameraFromSubject(const ViewSettings& view) {
  const Vector3d position = ToVector(view.position_m);
  const Vector3d forward = (ToVector(view.look_at_m) - position).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  const Vector3d down = forward.cross(right);
  const double roll_rad = view.roll_deg * kRadiansPerDegree;
  Matrix3<double> rotation;
  rotation.row(0) = (std::cos(roll_rad) * right + std::sin(roll_rad) * down).transpose();
  rotation.row(1) = (std::cos(roll_rad) * down - std::sin(roll_rad) * right).transpose();
  rotation.row(2) = forward.transpose();
  return {rotation, -(rotation * position)};
}

void OtherViewSettings::Describe(Fields& f) {
  f.Text("name", name, {.meaning = "name of the view's folder", .required = true});
  f.Section("view", view, {.meaning = "the camera and where it stands"});
}

void SceneSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "what the scene shows, for people"});
  f.Section("body", body, {.meaning = "the person"});
  f.Section("motion", motion, {.meaning = "what the person does", .required = true});
  f.Section("truth", truth, {.meaning = "the true surface, which is rendered"});
  f.Section("subject", subject, {.meaning = "the template that a tracker is given"});
  f.Section("view", view, {.meaning = "the camera and where it stands"});
  f.List("views", views,
         {.meaning = "other cameras that record the same, for scores; no tracker sees them"});
  f.Section("occluder", occluder,
            {.meaning = "post or second person that moves between camera and subject"});
  f.Section("carried", carried, {.meaning = "what the subject carries"});
  f.Section("room", room, {.meaning = "static room round the subject"});
  f.Section("sensor", sensor, {.meaning = "sensor model of the camera"});
  f.Integer("frames", frames, {.meaning = "length of the sequence", .min = 1, .max = 100000});
  f.Number("fps", fps,
           {.meaning = "frames per second",
            .min = 0.1,
            .max = 1000.0,
            .origin = Origin::kPaper,
            .source = "paper A, sec. 6.2: 30 frames/s"});
  f.Integer("seed", seed, {.meaning = "seed of the sensor's noise", .min = 0});
}

std::string SceneSettings::Problem() const {
  const auto& p = view.position_m;
  const bool above_the_start = std::hypot(p[0], p[2]) < kStandingRoomM;
  if (above_the_start && p[1] >= 0.0 && p[1] <= body.height_m) {
    return fmt::format(
        "view.position_m: the camera at ({:g}, {:g}, {:g}) stands inside the body; expected at "
        "least {:g} m away from the axis on which the subject first stands",
        p[0], p[1], p[2], kStandingRoomM);
  }
  return "";
}

void SynthesizeSequence(const SceneSettings& settings, const std::filesystem::path& folder) {
  const ControlBody body = MakeControlBody(settings.body);
  const BodyModel truth = Refine(body, settings.truth.refinement);
  const BodyModel subject = Refine(body, settings.subject);
  const std::unique_ptr<Motion> motion = LoadMotion(settings.motion, body.skeleton);
  RecordSequence(settings, truth, subject, *motion, folder);
}

}  // namespace vitruvia
