// Files are written whole or not at all: under a temporary name first, then renamed.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vitruvia {

// DataError naming the file if it cannot be read.
std::string ReadWholeFile(const std::filesystem::path& file);

// RunError naming the file if it cannot be written; no partial file remains.
void WriteWholeFile(const std::filesystem::path& file, std::string_view content);

// RunError naming the folder and the reason if it does not exist and cannot be created.
void MakeFolder(const std::filesystem::path& folder);

// The folder for temporary files: $TMPDIR, or /tmp if that is not set. RunError naming the variable
// if it is not a folder.
std::filesystem::path TemporaryDirectory();

// Removes temporary files or folders that a killed process left beside the destination (a file or a
// folder). The caller ensures that no other process is writing the destination.
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
