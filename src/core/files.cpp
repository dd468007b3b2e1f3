#include "core/files.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"
#include "core/write_failure.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// The computer's name: several may share a folder.
std::string HostName() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string TemporaryPrefix(const fs::path& destination) {
  return fmt::format(".{}.", destination.filename().string());
}

constexpr const char* kTemporaryEnd = ".part";
constexpr const char* kOldEnd = ".old";  // of what a staged folder replaces

// Beside the destination, so that the final rename stays on one file system.
fs::path TemporaryName(const fs::path& destination) {
  static const std::string host = HostName();
  return destination.parent_path() /
         fmt::format("{}{}-{}{}", TemporaryPrefix(destination), host, getpid(), kTemporaryEnd);
}

}  // namespace

std::string ReadWholeFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) {
    throw DataError(fmt::format("{}: cannot be opened for reading", file.string()));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

void FailToWrite(const fs::path& file, int error) {
  throw RunError(fmt::format("{}: cannot be written: {}", file.string(),
                             error == 0 ? "no reason is known" : std::strerror(error)));
}

void WriteWholeFile(const fs::path& file, std::string_view content) {
  const fs::path temporary = TemporaryName(file);
  int error = 0;
  {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) error = errno != 0 ? errno : EIO;
  }
  std::error_code not_renamed, ignored;
  if (error == 0) fs::rename(temporary, file, not_renamed);
  if (error == 0 && !not_renamed) return;
  fs::remove(temporary, ignored);
  FailToWrite(file, error != 0 ? error : not_renamed.value());
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw RunError(fmt::format("{}: folder cannot be made: {}", folder.string(),
                               error ? error.message() : "a file of that name is in the way"));
  }
}

fs::path TemporaryDirectory() {
  const char* variable = std::getenv("TMPDIR");
  const bool is_set = variable != nullptr && *variable != '\0';
  fs::path folder = is_set ? variable : "/tmp";
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return folder;
  throw RunError(fmt::format(
      "{}{}: expected a folder for temporary files, found none; make it, or set TMPDIR to another",
      is_set ? "TMPDIR=" : "", folder.string()));
}

void RemoveUnfinished(const fs::path& destination) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(destination.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool unfinished = name.starts_with(TemporaryPrefix(destination)) &&
                            (name.ends_with(kTemporaryEnd) || name.ends_with(kOldEnd));
    if (unfinished) fs::remove_all(entry.path(), ignored);
  }
}

StagedFolder::StagedFolder(fs::path destination, const std::string& mark)
    : destination_(std::move(destination)) {
  if (!destination_.has_filename()) destination_ = destination_.parent_path();
  const fs::path name = destination_.filename();
  if (name.empty() || name == "." || name == "..") {
    throw RunError(fmt::format("{}: is no folder to write to; name a new one below it",
                               destination_.string()));
  }
  std::error_code error;
  const fs::file_status status = fs::status(destination_, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw RunError(
        fmt::format("{}: is a file; expected a folder to write to", destination_.string()));
  }
  if (fs::is_directory(status) && !fs::is_empty(destination_, error) &&
      !fs::exists(destination_ / mark, error)) {
    throw RunError(fmt::format("{}: holds other things (there is no {}) and is not overwritten",
                               destination_.string(), mark));
  }
  staging_ = TemporaryName(destination_);
  fs::remove_all(staging_, error);
  try {
    if (destination_.has_parent_path()) MakeFolder(destination_.parent_path());
    MakeFolder(staging_);
  } catch (const RunError& reason) {
    throw RunError(fmt::format("{}: cannot be written: {}", destination_.string(), reason.what()));
  }
}

StagedFolder::~StagedFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void StagedFolder::Commit() {
  // The old folder is renamed first and removed last, so that one of the two is complete at any
  // time.
  fs::path old = staging_;
  old += kOldEnd;
  std::error_code error;
  const bool replaces = fs::exists(destination_, error);
  if (replaces) fs::rename(destination_, old, error);
  if (!error) fs::rename(staging_, destination_, error);
  std::error_code ignored;
  if (error) {
    if (replaces) fs::rename(old, destination_, ignored);
    throw RunError(
        fmt::format("{}: cannot be written: {}", destination_.string(), error.message()));
  }
  committed_ = true;
  if (replaces) fs::remove_all(old, ignored);
}

}  // namespace vitruvia
