// The last step of every import: the new sequence is verified before it is published.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sequence/sequence.h"

namespace vitruvia {

// Completes the sequence, checks its parts against each other, and publishes it at `folder`. Prints
// all warnings and stores them in its provenance: the importer's (empty ones are ignored) and those
// of the verification, which reads images on `threads` threads. If the parts are inconsistent,
// throws DataError and leaves no files.
void PublishChecked(SequenceWriter& writer, const std::filesystem::path& folder,
                    const std::vector<std::string>& warnings, int threads = 1);

}  // namespace vitruvia
