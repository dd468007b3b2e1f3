#include "synth/scan/record_scan.h"

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/progress.h"
#include "math/rigid.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"
#include "synth/scan/scan_recorder.h"

namespace vitruvia {
namespace {

Json Rows(const Rigidd& transform) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    rows.push_back({transform.rotation(i, 0), transform.rotation(i, 1), transform.rotation(i, 2),
                    transform.translation[i]});
  }
  return rows;
}

}  // namespace

void RecordScan(const ScanSceneSettings& settings, const std::filesystem::path& folder) {
  ScanRecorder recorder(settings);
  SequenceInfo info;
  info.camera = settings.camera;
  info.depth_unit_m = settings.sensor.depth_unit_m;
  info.fps = settings.fps;
  info.frames = settings.frames;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  info.provenance = {{"made_by", "vitruvia scan --store-frames"},
                     {"scene", WriteSettings(settings)},
                     {"build", Provenance()}};
  SequenceWriter writer(folder, info, recorder.body(), recorder.body().rest);
  Progress progress("store " + folder.filename().string(), settings.frames);
  for (int frame = 0; frame < settings.frames; ++frame) {
    const ScanFrame rendered = recorder.Render(frame);
    if (frame == 0) writer.Note("first_camera_from_subject", Rows(rendered.camera_from_subject));
    writer.Append(
        rendered.depth, rendered.vertices,
        {rendered.joints, VisibleJoints(rendered.joints, rendered.depth, settings.camera)});
    progress.Advance();
  }
  writer.Finish();
}

}  // namespace vitruvia
