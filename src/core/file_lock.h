// Locks between processes that share a folder, on one machine or over a network file system.
//
// A lock belongs to a file and ends with the process that holds it, however that ends: nothing has
// to be cleaned up after kill -9. Linux's open file description locks: two locks of one process
// exclude each other too, and a process forked while a lock is held shares it. The file itself
// stays, empty.
#pragma once

#include <filesystem>
#include <optional>

namespace vitruvia {

enum class LockKind {
  kShared,     // any number at a time, but none beside an exclusive one
  kExclusive,  // one at a time
};

class FileLock {
 public:
  // Nothing if another holder is in the way. RunError if the file cannot be opened or locked.
  static std::optional<FileLock> Try(const std::filesystem::path& file, LockKind kind);
  // Waits until the lock is free. Stops with Error(kInterrupted) if that was asked for.
  static FileLock Wait(const std::filesystem::path& file, LockKind kind);
  // Whether anybody holds the lock; asking disturbs nobody.
  static bool Held(const std::filesystem::path& file);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace vitruvia
