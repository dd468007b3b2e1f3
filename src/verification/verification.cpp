#include "verification/verification.h"

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "core/message.h"
#include "math/evenly_spread.h"
#include "verification/checks.h"
#include "verification/limits.h"
#include "verification/rest_mesh_check.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

bool HasError(const Findings& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::kError; });
}

int CountOf(FrameSelection selection, int frames) {
  using namespace verification_limits;
  if (selection == FrameSelection::kAll) return frames;
  return std::clamp(frames / kFramesPerSample, kFewestSampledFrames, kMostSampledFrames);
}

Findings CheckSubjectOf(const SequenceReader& sequence) {
  if (!sequence.info().subject) return {};
  Findings findings = CheckSubject(sequence.subject());
  for (Finding& finding : findings) finding.text = "subject/" + finding.text;
  return findings;
}

Findings CheckRestMeshOf(const SequenceReader& sequence) {
  if (!sequence.info().subject || !sequence.info().surface) return {};
  return CheckRestMesh(sequence.true_rest_mesh(), sequence.subject(), "truth/mesh.ply");
}

void RefuseErrors(const Findings& findings, const fs::path& shown_as) {
  for (const Finding& finding : findings) {
    if (finding.severity == Severity::kError)
      throw DataError(fmt::format("{}: {}", shown_as.string(), finding.text));
  }
}

// Warnings of what came before an error are printed too: they may be its cause.
std::vector<std::string> Judge(const Findings& findings, const fs::path& shown_as) {
  std::vector<std::string> warnings;
  for (const Finding& finding : findings) {
    if (finding.severity == Severity::kError) continue;
    PrintMessage("warning: {}: {}\n", shown_as.string(), finding.text);
    warnings.push_back(finding.text);
  }
  RefuseErrors(findings, shown_as);
  return warnings;
}

}  // namespace

Findings FindInconsistencies(const SequenceReader& sequence, FrameSelection selection,
                             int threads) {
  const std::vector<int> frames =
      EvenlySpread(sequence.info().frames, CountOf(selection, sequence.info().frames));
  const std::function<Findings()> checks[] = {
      [&] { return CheckCamera(sequence.info().camera); },
      [&] { return CheckSubjectOf(sequence); },
      [&] { return CheckRestMeshOf(sequence); },
      [&] { return CheckTrueJoints(sequence); },
      [&] { return CheckTrueSurface(sequence, frames); },
      [&] { return CheckImages(sequence, frames, threads); },
      [&] { return CheckDepth(sequence, frames); },
      [&] { return CheckFrames(sequence, frames); },
  };
  Findings all;
  for (const auto& check : checks) {
    const Findings found = check();
    all.insert(all.end(), found.begin(), found.end());
    if (HasError(found)) break;
  }
  return all;
}

std::vector<std::string> RequireConsistent(const SequenceReader& sequence, FrameSelection selection,
                                           const fs::path& shown_as, int threads) {
  return Judge(FindInconsistencies(sequence, selection, threads), shown_as);
}

std::vector<std::string> RequireConsistent(const BodyModel& subject, const fs::path& shown_as) {
  return Judge(CheckSubject(subject), shown_as);
}

void RequireRestMeshOf(const BodyModel& subject, const fs::path& subject_folder,
                       const TriangleMesh& true_rest, const fs::path& rest_file) {
  RefuseErrors(CheckSubject(subject), subject_folder);
  RefuseErrors(CheckRestMesh(true_rest, subject, rest_file.filename().string()),
               rest_file.parent_path());
}

}  // namespace vitruvia
