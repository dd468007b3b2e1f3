#include "support/eval_file_writer.h"

#include "core/files.h"

namespace vitruvia {
namespace {

constexpr std::int32_t kSomeMagic = 0x1badcafe;
constexpr double kMarkerBesideJoint_m = 0.02;

std::array<float, 3> Floats(const Vector3<float>& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

std::array<float, 3> EvalPlace(const Vector3<double>& p) {
  return Floats(Vector3<double>(p.x(), -p.y(), -p.z()).cast<float>());
}

void AddEvalMarker(const std::string& name, const Vector3<double>& point, EvalFrameBytes& frame) {
  EvalMarkerBytes& marker = frame.markers.at(frame.marker_count++);
  name.copy(marker.name.data(), marker.name.size());
  marker.place = EvalPlace(point);
}

void AddEvalJoint(int id, const Vector3<double>& point, EvalFrameBytes& frame) {
  frame.joints.at(frame.joint_count++) = {id, EvalPlace(point)};
}

void SetEvalPoints(const DepthImage& depth, const PinholeCamera& camera, EvalFrameBytes& frame) {
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (depth(u, v) == 0.0f) continue;
      frame.points[v][u] = EvalPlace(camera.Unproject<double>(u, v, depth(u, v)));
    }
  }
}

void WriteEvalFile(const std::filesystem::path& file, const std::vector<EvalFrameBytes>& frames) {
  WriteWholeFile(
      file, {reinterpret_cast<const char*>(frames.data()), frames.size() * sizeof(EvalFrameBytes)});
}

std::vector<EvalFrameBytes> EvalFramesOf(const SequenceReader& sequence, int first_id) {
  std::vector<EvalFrameBytes> frames(sequence.info().frames);
  const std::vector<std::string>& joints = sequence.info().joints;
  for (int i = 0; i < sequence.info().frames; ++i) {
    frames[i].magic = kSomeMagic;
    frames[i].number = i;
    SetEvalPoints(sequence.ReadDepth(i), sequence.info().camera, frames[i]);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Vector3<double>& place = sequence.true_joints(i).positions[j];
      AddEvalJoint(first_id + static_cast<int>(j), place, frames[i]);
      AddEvalMarker(joints[j], place + Vector3<double>(kMarkerBesideJoint_m, 0.0, 0.0), frames[i]);
    }
  }
  return frames;
}

}  // namespace vitruvia
