// What an earlier report drew, for the runs for which it would be drawn the same again.
//
// A report leaves drawn.cbor beside its figures: each run's pictures as PNG, what is known of its
// causes, and a digest of what they were drawn from: the program, the run's record, estimate and
// surfaces, its sequence, the experiment's picture frames. Where the digest or a sheet differs, or
// the file is no such file, the run is drawn anew.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/pictures/cause_pictures.h"
#include "reports/pictures/pictures.h"

namespace vitruvia {

class DrawnBefore {
 public:
  DrawnBefore() = default;  // nothing
  // `folder`: with the figures of the earlier report, if there is one.
  DrawnBefore(const ReportedExperiment& experiment, const std::filesystem::path& folder);

  // Null: to be drawn. `id` is that of the pictures: a run's, or of pictures that several runs
  // share, which hold as long as all runs do. Images are there encoded only.
  const RunPictures* Pictures(const std::string& id) const;
  const RunCauses* Causes(const std::string& run_id) const;

  // Leaves for the next report what this one has.
  void Keep(const std::vector<RunPictures>& pictures, const std::vector<RunCauses>& causes,
            const std::filesystem::path& folder) const;

 private:
  std::string DigestFor(const std::string& id) const;
  void Read(const std::filesystem::path& folder);

  std::map<std::string, std::string> digests_;  // of the finished runs, by id
  std::string digest_of_all_;
  std::map<std::string, RunPictures> pictures_;
  std::map<std::string, RunCauses> causes_;
};

}  // namespace vitruvia
