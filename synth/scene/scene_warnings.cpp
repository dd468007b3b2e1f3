#include "synth/scene/scene_warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vitruvia {
namespace {

constexpr double kLittle = 0.005;  // share of the person's pixels, below which nobody is warned

std::vector<std::string> MotionWarnings(const SceneSettings& settings, const Motion& motion) {
  std::vector<std::string> warnings = motion.warnings();
  if (motion.repeats()) return warnings;
  int held = 0;
  for (int frame = 0; frame < settings.frames; ++frame) {
    held += frame / settings.fps > motion.duration_s() + 0.5 / settings.fps;
  }
  if (held > 0) {
    warnings.push_back(fmt::format(
        "{}: the motion ends after {:.2f} s, the scene's {} frames at {:g} frames/s take {:.2f} s: "
        "the last {} frames hold the last pose",
        settings.motion.file.string(), motion.duration_s(), settings.frames, settings.fps,
        settings.frames / settings.fps, held));
  }
  return warnings;
}

// Trackers take all that the first frame shows for the person, unless a mask says otherwise; scenes
// with a room have one.
std::string FirstFrameWarning(const SceneSettings& settings, Stage& stage) {
  const TruePose body = stage.PosedAt(0.0);
  const DepthImage seen = stage.Rendered(0.0, body);
  const DepthImage alone = stage.RenderedAlone(body);
  const MaskImage visible = stage.BodyMask(body, seen);
  int person = 0, hidden = 0, foreign = 0;
  for (std::size_t i = 0; i < seen.pixels().size(); ++i) {
    const bool is_person = alone.pixels()[i] > 0.0f, is_visible = visible.pixels()[i] > 0;
    person += is_person ? 1 : 0;
    hidden += is_person && !is_visible ? 1 : 0;
    foreign += seen.pixels()[i] > 0.0f && !is_visible ? 1 : 0;
  }
  const double least = kLittle * person;
  if (person == 0) return "the first frame does not show the person";
  const bool is_masked = settings.room.IsThere();
  if (hidden <= least && (is_masked || foreign <= least)) return "";
  std::string text = "the first frame does not show the whole person alone:";
  if (hidden > least)
    text += fmt::format(" {:.0f} % of the person are hidden;", 1e2 * hidden / person);
  if (!is_masked && foreign > least)
    text += fmt::format(
        " what hides shows {:.0f} % as many pixels as the person, and a tracker takes them "
        "for the person;",
        1e2 * foreign / person);
  return text + " occluder.from_s and carried.from_s let it come later";
}

}  // namespace

std::vector<std::string> SceneWarnings(const SceneSettings& settings, const Motion& motion,
                                       Stage& stage) {
  std::vector<std::string> warnings = MotionWarnings(settings, motion);
  const std::string first_frame = FirstFrameWarning(settings, stage);
  if (!first_frame.empty()) warnings.push_back(first_frame);
  return warnings;
}

}  // namespace vitruvia
