// Files are written whole or not at all: under a temporary name first, then renamed.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vitruvia {

// DataError naming the file if it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& file);

// RunError naming the file if it cannot be written; then nothing is left behind.
void WriteWholeFile(const std::filesystem::path& file, std::string_view content);

// RunError naming the folder and the reason if it neither exists nor can be made.
void MakeFolder(const std::filesystem::path& folder);

// The folder for temporary files: $TMPDIR, or /tmp without it. RunError naming the variable if that
// is no folder.
std::filesystem::path TemporaryDirectory();

// Removes what a killed process left unfinished beside the destination, a file or a folder. The
// caller makes sure that no other process is writing the destination.
void RemoveUnfinished(const std::filesystem::path& destination);

// A folder that is filled under a temporary name beside its destination and moved there by
// Commit(); without Commit() it is removed again. Commit() replaces an existing destination, but
// only one that is empty or holds `mark`, a file that every folder of this kind has: a mistyped
// path must not delete a folder of other things. Otherwise the constructor throws RunError.
class StagedFolder {
 public:
  StagedFolder(std::filesystem::path destination, const std::string& mark);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return staging_; }
  void Commit();

 private:
  std::filesystem::path destination_, staging_;
  bool committed_ = false;
};

}  // namespace vitruvia
