// The end of every import: the new sequence is verified before it appears.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sequence/sequence.h"

namespace vitruvia {

// Completes the sequence, holds its parts against each other, and publishes it at `folder` with all
// warnings printed and noted in its provenance: the importer's own, empty ones left out, and the
// verification's. DataError, and nothing is left, if the parts cannot belong together.
void PublishChecked(SequenceWriter& writer, const std::filesystem::path& folder,
                    const std::vector<std::string>& warnings);

}  // namespace vitruvia
