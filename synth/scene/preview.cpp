#include "synth/scene/preview.h"

#include <algorithm>

#include "synth/scene/scene_warnings.h"

namespace vitruvia {

ScenePreview PreviewScene(const SceneSettings& settings, int count) {
  const ControlBody body = MakeControlBody(settings.body);
  const BodyModel truth = Refine(body, settings.truth.refinement);
  const std::unique_ptr<Motion> motion = LoadMotion(settings.motion, body.skeleton);
  Stage stage(settings, truth, *motion);
  const StageSensor sensor(settings);
  ScenePreview preview;
  preview.warnings = SceneWarnings(settings, *motion, stage);
  const int shown = std::min(count, settings.frames);
  for (int i = 0; i < shown; ++i) {
    const int frame = shown > 1 ? i * (settings.frames - 1) / (shown - 1) : 0;
    const double time_s = frame / settings.fps;
    const TruePose posed = stage.PosedAt(time_s);
    const DepthImage true_depth = stage.Rendered(time_s, posed);
    const MaskImage mask = stage.BodyMask(posed, true_depth);
    preview.frames.push_back(
        {frame, time_s, sensor.Measured(frame, time_s, true_depth, stage), mask});
  }
  return preview;
}

}  // namespace vitruvia
