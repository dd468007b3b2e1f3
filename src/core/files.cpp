#include "core/files.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Beside the destination, so that the final rename stays on one file system.
fs::path TemporaryName(const fs::path& destination) {
  return destination.parent_path() /
         fmt::format(".{}.{}.part", destination.filename().string(), getpid());
}

}  // namespace

std::string ReadWholeFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) {
    throw DataError(fmt::format("{}: cannot be opened for reading", file.string()));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

void WriteWholeFile(const fs::path& file, std::string_view content) {
  const fs::path temporary = TemporaryName(file);
  std::error_code error;
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) error = std::make_error_code(std::errc::io_error);
  }
  if (!error) fs::rename(temporary, file, error);
  if (error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw RunError(fmt::format("{}: cannot be written (folder missing, not writable, or disk full)",
                               file.string()));
  }
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw RunError(fmt::format("{}: folder cannot be made: {}", folder.string(),
                               error ? error.message() : "a file of that name is in the way"));
  }
}

StagedFolder::StagedFolder(fs::path destination) : destination_(std::move(destination)) {
  if (!destination_.has_filename()) destination_ = destination_.parent_path();
  if (destination_.has_parent_path()) MakeFolder(destination_.parent_path());
  if (fs::exists(destination_) && !fs::is_directory(destination_)) {
    throw RunError(
        fmt::format("{}: is a file; expected a folder to write to", destination_.string()));
  }
  staging_ = TemporaryName(destination_);
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  MakeFolder(staging_);
}

StagedFolder::~StagedFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void StagedFolder::Commit() {
  std::error_code error;
  fs::remove_all(destination_, error);
  if (!error) fs::rename(staging_, destination_, error);
  if (error) {
    throw RunError(
        fmt::format("{}: cannot be written: {}", destination_.string(), error.message()));
  }
  committed_ = true;
}

}  // namespace vitruvia
