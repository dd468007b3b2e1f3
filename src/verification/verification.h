// Checks the parts of a sequence for consistency: camera, depth, truth and subject must have the
// same unit, frame of reference, order and person.
//
// The reader checks that each file is intact; these checks find intact files with wrong content,
// such as depth in another unit, a camera of another resolution, a truth in millimetres or mirrored
// images.
#pragma once

#include <filesystem>

#include "sequence/sequence.h"
#include "verification/finding.h"

namespace vitruvia {

enum class FrameSelection {
  kSample,  // a few evenly spread frames, for the check before a run
  kAll,
};

// Findings in the order of the checks: camera, subject, true surface at rest, true joints, true
// surface, images, depth against truth. Stops at the first error, because later checks depend on
// earlier ones. DataError if a file is damaged.
// `threads`: for reading the images.
Findings FindInconsistencies(const SequenceReader& sequence, FrameSelection frames,
                             int threads = 1);

// Prints every warning and returns their texts; DataError with the first error. Messages name files
// below `shown_as`, the current or future folder of the sequence.
std::vector<std::string> RequireConsistent(const SequenceReader& sequence, FrameSelection frames,
                                           const std::filesystem::path& shown_as, int threads = 1);

// The same for the subject alone, for a template that is not part of the sequence.
std::vector<std::string> RequireConsistent(const BodyModel& subject,
                                           const std::filesystem::path& shown_as);

// Before frames are imported: DataError if the subject or the rest mesh of the frames is of another
// unit, place, frame of reference or person than the other. Prints nothing.
void RequireRestMeshOf(const BodyModel& subject, const std::filesystem::path& subject_folder,
                       const TriangleMesh& true_rest, const std::filesystem::path& rest_file);

}  // namespace vitruvia
