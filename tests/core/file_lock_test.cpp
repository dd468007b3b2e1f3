#include "core/file_lock.h"

#include <csignal>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {

class Locks : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "lock";
};

TEST_F(Locks, OneExclusiveHolderAtATime) {
  EXPECT_FALSE(FileLock::Held(file_));  // nor is there a file
  {
    const std::optional<FileLock> lock = FileLock::Try(file_, LockKind::kExclusive);
    ASSERT_TRUE(lock.has_value());
    EXPECT_FALSE(FileLock::Try(file_, LockKind::kExclusive).has_value());
    EXPECT_FALSE(FileLock::Try(file_, LockKind::kShared).has_value());
    EXPECT_TRUE(FileLock::Held(file_));
  }
  EXPECT_FALSE(FileLock::Held(file_));
  EXPECT_TRUE(FileLock::Try(file_, LockKind::kExclusive).has_value());
}

TEST_F(Locks, SharedHoldersKeepAnExclusiveOneOut) {
  const std::optional<FileLock> one = FileLock::Try(file_, LockKind::kShared);
  std::optional<FileLock> two = FileLock::Try(file_, LockKind::kShared);
  ASSERT_TRUE(one && two);
  EXPECT_FALSE(FileLock::Try(file_, LockKind::kExclusive).has_value());
  const FileLock moved = std::move(*two);
  two.reset();
  EXPECT_TRUE(FileLock::Held(file_));
}

TEST_F(Locks, EndWithTheirProcessHoweverItEnds) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t holder = fork();
  if (holder == 0) {
    const FileLock lock = FileLock::Wait(file_, LockKind::kExclusive);
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_TRUE(FileLock::Held(file_));
  kill(holder, SIGKILL);
  waitpid(holder, nullptr, 0);
  EXPECT_FALSE(FileLock::Held(file_));
}

TEST_F(Locks, AreReleasedAlthoughAForkedProcessStillHasACopy) {
  std::optional<FileLock> lock = FileLock::Try(file_, LockKind::kExclusive);
  const pid_t copy = fork();
  if (copy == 0) {
    pause();
    _exit(0);
  }
  lock.reset();
  EXPECT_FALSE(FileLock::Held(file_));
  kill(copy, SIGKILL);
  waitpid(copy, nullptr, 0);
}

TEST_F(Locks, OfAllUsersMayBeTakenByAllWhateverTheUmask) {
  const mode_t before = umask(077);
  MakeLockFileForAllUsers(file_);
  umask(before);
  EXPECT_EQ(std::filesystem::status(file_).permissions(), std::filesystem::perms{0666});
  const std::optional<FileLock> lock = FileLock::Try(file_, LockKind::kExclusive);
  ASSERT_TRUE(lock.has_value());
  MakeLockFileForAllUsers(file_);  // leaves a file that is there, and its lock, as they are
  EXPECT_TRUE(FileLock::Held(file_));
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    ++files;
  EXPECT_EQ(files, 1);  // no temporary one is left
  EXPECT_THROW(MakeLockFileForAllUsers(folder_ / "none" / "lock"), RunError);
}

TEST_F(Locks, OfFoldersThatAreNotThereAreRefused) {
  EXPECT_THROW(FileLock::Try(folder_ / "none" / "lock", LockKind::kShared), RunError);
}

TEST_F(Locks, WhatAKilledProcessLeftUnfinishedIsRemoved) {
  MakeFolder(folder_ / ".work.host-12.part");
  MakeFolder(folder_ / ".work.host-12.part.old");
  WriteWholeFile(folder_ / ".work.host-12.part" / std::string("file"), "half");
  MakeFolder(folder_ / ".workshop.host-12.part");
  MakeFolder(folder_ / "work");
  RemoveUnfinished(folder_ / "work");
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".work.host-12.part"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".work.host-12.part.old"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / ".workshop.host-12.part"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "work"));
}

}  // namespace
}  // namespace vitruvia
