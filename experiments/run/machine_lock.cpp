#include "experiments/run/machine_lock.h"

#include <cstdlib>

#include "core/error.h"
#include "core/message.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLockName = "vitruvia-runs.lock";
constexpr const char* kUsualFolder = "/run/lock";
constexpr const char* kOtherFolder = "/tmp";

// The same answer for every user of the machine.
bool AllUsersCanWriteTo(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  return fs::is_directory(status) &&
         (status.permissions() & fs::perms::others_write) != fs::perms::none;
}

fs::path LockFolder() {
  const char* variable = std::getenv(kLockFolderVariable);
  if (variable != nullptr && *variable != '\0') return variable;
  return AllUsersCanWriteTo(kUsualFolder) ? kUsualFolder : kOtherFolder;
}

}  // namespace

fs::path MachineLockFile() {
  const fs::path file = LockFolder() / kLockName;
  try {
    MakeLockFileForAllUsers(file);
  } catch (const RunError& error) {
    throw RunError(fmt::format(
        "{}; runs need this file to leave timed runs alone on the machine: set {} to a folder that "
        "all jobs and users of the machine can write to",
        error.what(), kLockFolderVariable));
  }
  return file;
}

FileLock LockMachine(LockKind kind) {
  const fs::path file = MachineLockFile();
  if (std::optional<FileLock> lock = FileLock::Try(file, kind)) return std::move(*lock);
  PrintMessage("waiting: {} (lock file {})\n",
               kind == LockKind::kExclusive
                   ? "timed runs need the machine to themselves, and other runs go on"
                   : "a timed run goes on and needs the machine to itself",
               file.string());
  return FileLock::Wait(file, kind);
}

}  // namespace vitruvia
