#include <algorithm>
#include <cmath>
#include <optional>

#include "core/files.h"
#include "core/worker_team.h"
#include "math/statistics.h"
#include "sequence/sequence_files.h"
#include "verification/checks.h"
#include "verification/depth_changes.h"
#include "verification/limits.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {
using namespace verification_limits;

// What one image says by itself.
struct ImageSummary {
  long measured = 0;
  float least_m = 0.0f, most_m = 0.0f;
};

ImageSummary Summarize(const DepthImage& depth) {
  ImageSummary summary;
  for (const float z : depth.pixels()) {
    if (!(z > 0.0f)) continue;
    if (summary.measured == 0) summary.least_m = summary.most_m = z;
    summary.least_m = std::min(summary.least_m, z);
    summary.most_m = std::max(summary.most_m, z);
    ++summary.measured;
  }
  return summary;
}

// Median difference between neighbours that are both measured; 0 if there are none.
double Roughness(const DepthImage& depth) {
  std::vector<double> steps;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u + 1 < depth.width(); ++u) {
      if (depth(u, v) > 0.0f && depth(u + 1, v) > 0.0f)
        steps.push_back(std::abs(depth(u + 1, v) - depth(u, v)));
    }
  }
  return steps.empty() ? 0.0 : Quantile(steps, 0.5);
}

std::optional<Finding> ByteOrderProblem(const DepthImage& depth, double unit_m, int frame) {
  const double as_is = Roughness(depth), swapped = Roughness(WithSwappedBytes(depth, unit_m));
  if (as_is <= kSwappedBytesRoughness * std::max(swapped, unit_m)) return std::nullopt;
  return Impossible(
      "depth/{}: neighbouring pixels differ by {:.3f} m in the median, and by {:.4f} m with the "
      "two bytes of each value swapped: were the bytes swapped when it was written? (PNG is "
      "big-endian)",
      SequenceFiles::FrameName(frame), as_is, swapped);
}

// Frames whose files are the same, byte by byte, as their predecessor's: first and last of a run.
struct RepeatedFrames {
  int first = 0, last = 0;
};

std::vector<RepeatedFrames> FindRepeated(const SequenceReader& sequence) {
  const SequenceFiles files{sequence.folder()};
  std::vector<RepeatedFrames> runs;
  std::uintmax_t size_before = 0;
  for (int i = 0; i < sequence.info().frames; ++i) {
    const std::uintmax_t size = fs::file_size(files.Depth(i));
    const bool same = i > 0 && size == size_before &&
                      ReadWholeFile(files.Depth(i)) == ReadWholeFile(files.Depth(i - 1));
    size_before = size;
    if (!same) continue;
    if (!runs.empty() && runs.back().last == i - 1) {
      runs.back().last = i;
    } else {
      runs.push_back({i - 1, i});
    }
  }
  return runs;
}

// The longest way of a true joint between the two frames; 0 without true joints.
double TrueMotion(const SequenceReader& sequence, const RepeatedFrames& run) {
  if (sequence.info().joints.empty()) return 0.0;
  const JointTruth& from = sequence.true_joints(run.first);
  const JointTruth& to = sequence.true_joints(run.last);
  double most_m = 0.0;
  for (std::size_t j = 0; j < from.positions.size(); ++j) {
    if (from.Knows(j) && to.Knows(j))
      most_m = std::max(most_m, (to.positions[j] - from.positions[j]).norm());
  }
  return most_m;
}

std::vector<ImageSummary> Summaries(const SequenceReader& sequence, const std::vector<int>& frames,
                                    int threads) {
  std::vector<ImageSummary> summaries(frames.size());
  WorkerTeam team(threads);
  team.For(static_cast<int>(frames.size()), 1, [&](int begin, int) {
    const auto i = static_cast<std::size_t>(begin);
    summaries[i] = Summarize(sequence.ReadDepth(frames[i]));
  });
  return summaries;
}

bool IsEmpty(const SequenceReader& sequence, int frame) {
  return Summarize(sequence.ReadDepth(frame)).measured == 0;
}

// Repeated images are no fault while nobody moves, or while the camera delivers nothing.
std::optional<Finding> RepetitionProblem(const SequenceReader& sequence) {
  const int frames = sequence.info().frames;
  const std::vector<RepeatedFrames> runs = FindRepeated(sequence);
  int repeated = 0;
  for (const RepeatedFrames& run : runs) repeated += run.last - run.first;
  const bool is_one_image = frames > 2 && repeated == frames - 1;
  for (const RepeatedFrames& run : runs) {
    const double motion_m = TrueMotion(sequence, run);
    const bool is_wrong = motion_m > kRepeatedMotion_m;
    const bool is_odd = is_one_image && sequence.info().joints.empty();
    if ((!is_wrong && !is_odd) || IsEmpty(sequence, run.first)) continue;
    return Finding{
        is_wrong && is_one_image ? Severity::kError : Severity::kWarning,
        fmt::format("depth/: frames {} to {} are the same image{} ({} of {} frames repeat the one "
                    "before); did the recording stop?",
                    run.first, run.last,
                    is_wrong ? fmt::format(", while a true joint moves by {:.2f} m", motion_m) : "",
                    repeated, frames)};
  }
  return std::nullopt;
}

}  // namespace

Findings CheckImages(const SequenceReader& sequence, const std::vector<int>& frames, int threads) {
  const std::vector<ImageSummary> summaries = Summaries(sequence, frames, threads);
  std::size_t empty = 0, constant = 0;
  float level_m = 0.0f;
  Findings findings;
  std::optional<int> first_empty;
  bool bytes_checked = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int frame = frames[i];
    const ImageSummary& summary = summaries[i];
    if (summary.measured == 0 && !first_empty) first_empty = frame;
    empty += summary.measured == 0 ? 1 : 0;
    if (summary.measured < kEnoughPixels) continue;
    if (summary.least_m == summary.most_m) {
      ++constant;
      level_m = summary.least_m;
      continue;
    }
    if (bytes_checked) continue;
    bytes_checked = true;
    if (const auto problem =
            ByteOrderProblem(sequence.ReadDepth(frame), sequence.info().depth_unit_m, frame))
      return {*problem};
  }
  const std::string of =
      fmt::format("{} of {} frames that were looked at", frames.size(), sequence.info().frames);
  if (empty == frames.size())
    return {
        Impossible("depth/: no pixel is measured in any of {}: every image is empty; does depth "
                   "fit 65535 × depth_unit_m = {:.4g} m, and does the mask leave anything?",
                   of, 65535.0 * sequence.info().depth_unit_m)};
  if (constant > 0 && constant + empty == frames.size())
    return {
        Impossible("depth/: all measured pixels have one value ({:g} m) in {} of {}: a mask "
                   "stored as depth?",
                   level_m, constant, of)};
  if (constant > 0)
    findings.push_back(
        Warning("depth/: all measured pixels have one value in {} of {}, {:g} m in "
                "the last of them; did the camera stop?",
                constant, of, level_m));
  if (static_cast<double>(empty) > kEmptyFramesShare * static_cast<double>(frames.size()))
    findings.push_back(
        Warning("depth/: {} of {} are empty, first frame {}", empty, of, *first_empty));
  if (first_empty == 0)
    findings.push_back(Warning("depth/{}: the first image is empty, where a tracker starts",
                               SequenceFiles::FrameName(0)));
  if (const auto problem = RepetitionProblem(sequence)) findings.push_back(*problem);
  return findings;
}

}  // namespace vitruvia
