// Holds the parts of a sequence against each other: camera, depth, truth and subject must be of one
// unit, one frame of reference, one order and one person.
//
// The reader checks that each file is whole; these checks find what is whole and wrong, such as
// depth in another unit, a camera of another resolution, a truth in millimetres or mirrored images.
#pragma once

#include <filesystem>

#include "sequence/sequence.h"
#include "verification/finding.h"

namespace vitruvia {

enum class FrameSelection {
  kSample,  // a few, evenly spread: what a run can afford
  kAll,
};

// Findings in the order of the checks: camera, subject, true surface at rest, true joints, true
// surface, images, depth against truth. Stops at the first error, since what follows rests on it.
// DataError if a file is damaged.
Findings FindInconsistencies(const SequenceReader& sequence, FrameSelection frames);

// Prints every warning and returns their texts; DataError with the first error. Messages name files
// below `shown_as`, where the sequence is or is about to be.
std::vector<std::string> RequireConsistent(const SequenceReader& sequence, FrameSelection frames,
                                           const std::filesystem::path& shown_as);

// Only the subject: the same for a template that does not come with the sequence.
std::vector<std::string> RequireConsistent(const BodyModel& subject,
                                           const std::filesystem::path& shown_as);

// Before frames are imported: DataError if the subject or the rest mesh of the frames is of another
// unit, place, frame of reference or person than the other. Prints nothing.
void RequireRestMeshOf(const BodyModel& subject, const std::filesystem::path& subject_folder,
                       const TriangleMesh& true_rest, const std::filesystem::path& rest_file);

}  // namespace vitruvia
