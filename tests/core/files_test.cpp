#include "core/files.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> Names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

template <class Exception>
std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "no error";
}

TEST(WriteWholeFile, WritesAndReplacesEveryByte) {
  const TemporaryFolder folder;
  const std::string content("a\0b\r\n\xff", 6);
  WriteWholeFile(folder / "file", "something longer that was there before");
  WriteWholeFile(folder / "file", content);
  EXPECT_EQ(ReadWholeFile(folder / "file"), content);
  EXPECT_THAT(Names(folder.path()), ElementsAre("file"));
}

TEST(WriteWholeFile, NamesTheFileThatCannotBeWrittenAndLeavesNothing) {
  const TemporaryFolder folder;
  WriteWholeFile(folder / "file", "x");
  fs::create_directory(folder / "folder");
  for (const char* name : {"missing/file", "file/below", "folder"}) {
    const fs::path target = folder / name;
    EXPECT_THAT(MessageOf<RunError>([&] { WriteWholeFile(target, "y"); }),
                HasSubstr(target.string() + ": cannot be written"));
  }
  EXPECT_THAT(Names(folder.path()), ElementsAre("file", "folder"));
  EXPECT_EQ(ReadWholeFile(folder / "file"), "x");
}

TEST(WriteWholeFile, KeepsTheOldContentWhereTheDiskIsFull) {
  const fs::path full = "/dev/full";
  if (!fs::exists(full)) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  // A file that is too large for the process stands for a full disk just as well, but would need a
  // signal handler; here the temporary name leads to the device that is always full.
  WriteWholeFile(folder / "file", "old");
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string process = std::string(host.data()) + "-" + std::to_string(getpid());
  fs::create_symlink(full, folder / (".file." + process + ".part"));
  EXPECT_THROW(WriteWholeFile(folder / "file", "new"), RunError);
  EXPECT_EQ(ReadWholeFile(folder / "file"), "old");
  EXPECT_THAT(Names(folder.path()), ElementsAre("file"));
}

TEST(ReadWholeFile, NamesWhatCannotBeRead) {
  const TemporaryFolder folder;
  const fs::path missing = folder / "missing";
  EXPECT_EQ(MessageOf<DataError>([&] { ReadWholeFile(missing); }),
            missing.string() + ": cannot be opened for reading");
  EXPECT_THROW(ReadWholeFile(folder.path()), DataError);
}

TEST(MakeFolder, MakesAllThatIsMissing) {
  const TemporaryFolder folder;
  MakeFolder(folder / "a/b/c");
  MakeFolder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
}

TEST(MakeFolder, NamesTheFolderAndTheReason) {
  const TemporaryFolder folder;
  WriteWholeFile(folder / "file", "x");
  for (const char* name : {"file", "file/below"}) {
    const fs::path target = folder / name;
    EXPECT_THAT(MessageOf<RunError>([&] { MakeFolder(target); }),
                HasSubstr(target.string() + ": folder cannot be made: "));
  }
}

TEST(StagedFolder, AppearsOnCommitOnly) {
  const TemporaryFolder folder;
  StagedFolder staged(folder / "new/result", "mark");
  WriteWholeFile(staged.path() / "mark", "1");
  EXPECT_FALSE(fs::exists(folder / "new/result"));
  staged.Commit();
  EXPECT_EQ(ReadWholeFile(folder / "new/result/mark"), "1");
  EXPECT_THAT(Names(folder / "new"), ElementsAre("result"));
}

TEST(StagedFolder, LeavesNothingWhereItIsNotCommitted) {
  const TemporaryFolder folder;
  {
    StagedFolder staged(folder / "result/", "mark");
    WriteWholeFile(staged.path() / "mark", "1");
    fs::create_directory(staged.path() / "inner");
  }
  EXPECT_THAT(Names(folder.path()), IsEmpty());
}

TEST(StagedFolder, KeepsTheOldOneUntilCommitAndThenReplacesItWhole) {
  const TemporaryFolder folder;
  const auto write = [&](const char* extra, bool commit) {
    StagedFolder staged(folder / "result", "mark");
    WriteWholeFile(staged.path() / "mark", extra);
    WriteWholeFile(staged.path() / extra, "");
    if (commit) staged.Commit();
  };
  write("first", true);
  write("second", false);
  EXPECT_THAT(Names(folder / "result"), ElementsAre("first", "mark"));
  write("third", true);
  EXPECT_THAT(Names(folder / "result"), ElementsAre("mark", "third"));
  EXPECT_THAT(Names(folder.path()), ElementsAre("result"));
}

TEST(StagedFolder, DoesNotOverwriteAFolderOfOtherThings) {
  const TemporaryFolder folder;
  const fs::path precious = folder / "precious";
  MakeFolder(precious);
  EXPECT_NO_THROW(StagedFolder(precious, "mark"));  // an empty one may be replaced
  WriteWholeFile(precious / "thesis", "x");
  EXPECT_EQ(MessageOf<RunError>([&] { StagedFolder(precious, "mark"); }),
            precious.string() + ": holds other things (there is no mark) and is not overwritten");
  EXPECT_EQ(MessageOf<RunError>([&] { StagedFolder(precious / "thesis", "mark"); }),
            (precious / "thesis").string() + ": is a file; expected a folder to write to");
  EXPECT_THROW(StagedFolder(precious / ".", "mark"), RunError);
  EXPECT_THROW(StagedFolder(precious / "..", "mark"), RunError);
  EXPECT_THROW(StagedFolder("", "mark"), RunError);
  EXPECT_THROW(StagedFolder("/", "mark"), RunError);
  EXPECT_THAT(Names(folder.path()), ElementsAre("precious"));
  EXPECT_THAT(Names(precious), ElementsAre("thesis"));
}

TEST(StagedFolder, NamesADestinationThatCannotBe) {
  const TemporaryFolder folder;
  WriteWholeFile(folder / "file", "x");
  EXPECT_THAT(MessageOf<RunError>([&] { StagedFolder(folder / "file/below/result", "mark"); }),
              HasSubstr((folder / "file/below").string() + ": folder cannot be made"));
}

TEST(TemporaryDirectory, IsThatOfTheVariableAndNamesItIfThereIsNone) {
  const TemporaryFolder folder;
  const char* variable = std::getenv("TMPDIR");
  const std::string before = variable == nullptr ? "/tmp" : variable;
  setenv("TMPDIR", folder.path().c_str(), 1);
  EXPECT_EQ(TemporaryDirectory(), folder.path());
  setenv("TMPDIR", (folder / "none").c_str(), 1);
  EXPECT_THAT(MessageOf<RunError>([] { TemporaryDirectory(); }),
              HasSubstr("TMPDIR=" + (folder / "none").string() + ": expected a folder"));
  setenv("TMPDIR", before.c_str(), 1);
}

}  // namespace
}  // namespace vitruvia
