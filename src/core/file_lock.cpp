#include "core/file_lock.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "core/error.h"
#include "core/progress.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kAskAgainAfter{20};
constexpr mode_t kLockFileMode = 0666;

struct flock WholeFile(LockKind kind) {
  struct flock range {};
  range.l_type = kind == LockKind::kShared ? F_RDLCK : F_WRLCK;
  range.l_whence = SEEK_SET;
  return range;
}

[[noreturn]] void FailToLock(const fs::path& file, int error) {
  throw RunError(fmt::format("{}: cannot be locked: {}", file.string(), std::strerror(error)));
}

// Opens an existing file without O_CREAT: in folders such as /tmp the kernel may refuse O_CREAT for
// files of other users (fs.protected_regular).
int OpenOrCreate(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor >= 0 || errno != ENOENT) return descriptor;
  return open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kLockFileMode);
}

}  // namespace

std::optional<FileLock> FileLock::Try(const fs::path& file, LockKind kind) {
  const int descriptor = OpenOrCreate(file);
  if (descriptor < 0) FailToLock(file, errno);
  FileLock lock(descriptor);
  const struct flock range = WholeFile(kind);
  if (fcntl(descriptor, F_OFD_SETLK, &range) == 0) return lock;
  if (errno != EAGAIN && errno != EACCES) FailToLock(file, errno);
  return std::nullopt;
}

FileLock FileLock::Wait(const fs::path& file, LockKind kind) {
  while (true) {
    if (std::optional<FileLock> lock = Try(file, kind)) return std::move(*lock);
    ThrowIfInterrupted();
    std::this_thread::sleep_for(kAskAgainAfter);
  }
}

bool FileLock::Held(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock range = WholeFile(LockKind::kExclusive);
  const bool asked = fcntl(descriptor, F_OFD_GETLK, &range) == 0;
  close(descriptor);
  return asked && range.l_type != F_UNLCK;
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  // Closing alone would not end a lock whose descriptor another process has inherited.
  struct flock range {};
  range.l_type = F_UNLCK;
  range.l_whence = SEEK_SET;
  fcntl(descriptor_, F_OFD_SETLK, &range);
  close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void MakeLockFileForAllUsers(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    // Created under a temporary name first, so that no process opens the file before its mode is
    // set.
    const fs::path mine = fmt::format("{}.{}", file.string(), getpid());
    const int descriptor = open(mine.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kLockFileMode);
    if (descriptor < 0) FailToLock(file, errno);
    const bool made = fchmod(descriptor, kLockFileMode) == 0 &&
                      (link(mine.c_str(), file.c_str()) == 0 || errno == EEXIST);
    const int error = errno;
    close(descriptor);
    unlink(mine.c_str());
    if (!made) FailToLock(file, error);
  }
  if (access(file.c_str(), R_OK | W_OK) != 0) FailToLock(file, errno);
}

}  // namespace vitruvia
