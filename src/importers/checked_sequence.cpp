#include "importers/checked_sequence.h"

#include "core/message.h"
#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;

void PublishChecked(SequenceWriter& writer, const fs::path& folder,
                    const std::vector<std::string>& warnings, int threads) {
  std::vector<std::string> all;
  for (const std::string& warning : warnings) {
    if (warning.empty()) continue;
    PrintMessage("warning: {}\n", warning);
    all.push_back(warning);
  }
  const fs::path staged = writer.Complete();
  for (std::string& found :
       RequireConsistent(SequenceReader(staged), FrameSelection::kAll, folder, threads))
    all.push_back(std::move(found));
  if (!all.empty()) writer.Note("warnings", all);
  writer.Publish();
}

}  // namespace vitruvia
