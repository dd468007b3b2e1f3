// Writes files of the layout of Stanford EVAL (importers/eval_file.h), independently of the reader:
// by a packed struct, as the data set's own programs have it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sequence/sequence.h"

namespace vitruvia {

#pragma pack(push, 1)
struct EvalMarkerBytes {
  std::array<char, 256> name;
  std::array<float, 3> place;
};
struct EvalJointBytes {
  std::int32_t id;
  std::array<float, 3> place;
};
struct EvalFrameBytes {
  std::int32_t magic, number;
  std::array<std::array<std::array<float, 3>, 320>, 240> points;
  std::int32_t marker_count;
  std::array<EvalMarkerBytes, 32> markers;
  std::int32_t joint_count;
  std::array<EvalJointBytes, 32> joints;
};
#pragma pack(pop)
static_assert(sizeof(EvalFrameBytes) == 930704);

// In EVAL's axes: y up, z negative before the camera.
std::array<float, 3> EvalPlace(const Vector3<double>& point_in_camera);

void AddEvalMarker(const std::string& name, const Vector3<double>& point_in_camera,
                   EvalFrameBytes& frame);
void AddEvalJoint(int id, const Vector3<double>& point_in_camera, EvalFrameBytes& frame);

// The points of one frame: depth unprojected, 0 where nothing was measured.
void SetEvalPoints(const DepthImage& depth, const PinholeCamera& camera, EvalFrameBytes& frame);

void WriteEvalFile(const std::filesystem::path& file, const std::vector<EvalFrameBytes>& frames);

// Frames of a sequence of ours: joint j of its truth is joint `first_id` + j, with a marker of the
// joint's name 2 cm beside it. The camera must have 320×240 pixels.
std::vector<EvalFrameBytes> EvalFramesOf(const SequenceReader& sequence, int first_id);

}  // namespace vitruvia
