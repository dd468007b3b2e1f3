// The lock that keeps timed runs alone on their machine. Every process that executes runs holds it:
// shared for concurrent runs, exclusive for timed ones.
//
// All jobs and users of the machine must see the same file, so it does not depend on TMPDIR, which
// batch systems set for each job. It is vitruvia-runs.lock in the folder that VITRUVIA_LOCK_DIR
// names, or else in /run/lock, or in /tmp if /run/lock is not writable for all users.
#pragma once

#include <filesystem>

#include "core/file_lock.h"

namespace vitruvia {

inline constexpr const char* kLockFolderVariable = "VITRUVIA_LOCK_DIR";

// The lock's file, made if it is missing. RunError naming the variable if it cannot be made.
std::filesystem::path MachineLockFile();

// Waits, with a message, until the lock is free. Throws Error(kInterrupted) when the user asks to
// stop.
FileLock LockMachine(LockKind kind);

}  // namespace vitruvia
