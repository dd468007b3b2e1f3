// Whole frames of both papers' trackers, step by step, on the scenes that docs/performance.md
// lists, and what comes before them: rendering a frame and reading it back.
#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "bench/bench.h"
#include "core/timer.h"
#include "math/rigid.h"
#include "methods/registry.h"
#include "sequence/sequence.h"
#include "support/temporary_folder.h"
#include "synth/scene/scene.h"

namespace vitruvia::bench {
namespace {
namespace fs = std::filesystem;

const fs::path kConfigs = fs::path(VITRUVIA_SOURCE_DIR) / "configs";

struct Case {
  const char* name;
  const char* scene;     // below configs/scenes
  const char* method;    // below configs/methods
  const char* settings;  // that differ from the method file's
  int frames;
};

constexpr const char* kCoarseToFine = R"({"association": {"pose_vertex_stride": 2,
  "pose_pixel_stride": 2}, "pose": {"iterations": 5}})";

// Cases of one scene share their sequence.
constexpr Case kCases[] = {
    {"fig11", "fig11.json", "realtime_scape.json", "{}", 120},
    {"S1_kinect_v1", "eval/S1.json", "realtime_scape.json", "{}", 120},
    {"dynamic_full", "dynamic_far.json", "dynamic.json", "{}", 40},
    {"dynamic_coarse", "dynamic_far.json", "dynamic.json", kCoarseToFine, 40},
};

SceneSettings SceneOf(const Case& c) {
  const fs::path file = kConfigs / "scenes" / c.scene;
  return ReadSettings<SceneSettings>(Merged(ReadJsonFile(file), {{"frames", c.frames}}),
                                     {file, ""});
}

MethodConfig MethodOf(const Case& c) {
  const fs::path file = kConfigs / "methods" / c.method;
  return ReadMethodConfig(Merged(ReadJsonFile(file), {{"settings", Json::parse(c.settings)}}),
                          {file, ""});
}

// A frame for each image of the sequence, and the time that each took to read.
std::vector<DepthFrame> ReadFrames(const SequenceReader& sequence, std::vector<double>& ms) {
  std::vector<DepthFrame> frames;
  for (int i = 0; i < sequence.info().frames; ++i) {
    const Stopwatch watch;
    DepthImage depth = sequence.ReadDepth(i);
    ms.push_back(watch.ElapsedMs());
    frames.push_back({i, i / sequence.info().fps, std::move(depth)});
  }
  return frames;
}

double MeanJointErrorMm(const TrackResult& result, const JointTruth& truth) {
  double sum_m = 0.0;
  for (std::size_t j = 0; j < truth.positions.size(); ++j)
    sum_m += (result.joints[j] - truth.positions[j]).norm();
  return 1e3 * sum_m / static_cast<double>(truth.positions.size());
}

void Track(const Case& c, const SequenceReader& sequence, const std::vector<DepthFrame>& frames,
           std::vector<Row>& rows) {
  const std::unique_ptr<Tracker> tracker = MakeTracker(MethodOf(c));
  tracker->Start(sequence.subject(), sequence.info().camera);
  std::vector<double> frame_ms, error_mm, iterations;
  std::map<std::string, std::vector<double>> step_ms;
  for (const DepthFrame& frame : frames) {
    const Stopwatch watch;
    const TrackResult result = tracker->TrackFrame(frame);
    const double ms = watch.ElapsedMs();
    if (frame.index == 0) continue;  // the start is no frame like the others
    frame_ms.push_back(ms);
    for (const NamedValue& step : result.step_ms) step_ms[step.name].push_back(step.value);
    iterations.push_back(result.iterations);
    error_mm.push_back(MeanJointErrorMm(result, sequence.true_joints(frame.index)));
  }
  const std::string name = c.name;
  rows.push_back(Spread(name + "_frame", frame_ms, "ms"));
  for (const auto& [step, times] : step_ms) {
    std::string row = fmt::format("{}_{}", name, step);
    std::replace(row.begin(), row.end(), ' ', '_');
    rows.push_back(Spread(std::move(row), times, "ms"));
  }
  rows.push_back(Spread(name + "_iterations", iterations, "1"));
  rows.push_back(Spread(name + "_joint_error", error_mm, "mm"));
}

}  // namespace

std::vector<Row> Frames() {
  const TemporaryFolder temporary;
  std::vector<Row> rows;
  for (const Case& c : kCases) {
    const SceneSettings scene = SceneOf(c);
    const fs::path folder = temporary / fs::path(c.scene).stem().string();
    if (!fs::exists(folder)) {
      const Stopwatch watch;
      SynthesizeSequence(scene, folder);
      rows.push_back(
          {std::string(c.name) + "_synthesis_per_frame", watch.ElapsedMs() / scene.frames, "ms"});
    }
    const SequenceReader sequence(folder);
    std::vector<double> read_ms;
    const std::vector<DepthFrame> frames = ReadFrames(sequence, read_ms);
    rows.push_back(Spread(std::string(c.name) + "_read", read_ms, "ms"));
    Track(c, sequence, frames, rows);
  }
  return rows;
}

}  // namespace vitruvia::bench
