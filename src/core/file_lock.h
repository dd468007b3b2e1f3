// Locks between processes that share a folder, on one machine or over a network file system.
//
// A lock belongs to a file and is released when the last process that holds it ends for any reason:
// nothing has to be cleaned up after kill -9. These are Linux's open file description locks: two
// locks of one process exclude each other too, and a process that inherits the descriptor shares
// the lock. The file itself stays, empty.
#pragma once

#include <filesystem>
#include <optional>

namespace vitruvia {

enum class LockKind {
  kShared,     // any number of holders, unless an exclusive lock is held
  kExclusive,  // one holder
};

class FileLock {
 public:
  // Nothing if another holder's lock conflicts. RunError if the file cannot be opened, created or
  // locked.
  static std::optional<FileLock> Try(const std::filesystem::path& file, LockKind kind);
  // Waits until the lock is free. Throws Error(kInterrupted) when the user asks to stop.
  static FileLock Wait(const std::filesystem::path& file, LockKind kind);
  // Whether any process holds the lock. Does not take the lock itself.
  static bool Held(const std::filesystem::path& file);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  // For a child process to inherit, so that the lock lasts as long as the child. Closed on exec.
  int descriptor() const { return descriptor_; }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

// Makes sure that the lock file exists and that every user of the machine may lock it, whatever the
// umask. RunError if it cannot be created, or if its permissions exclude this user.
void MakeLockFileForAllUsers(const std::filesystem::path& file);

}  // namespace vitruvia
