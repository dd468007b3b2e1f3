// What the repository must not say: paths of one machine, and addresses of package registries.
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.h"

namespace vitruvia {
namespace {
namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// None of these patterns matches its own text here.
constexpr const char* kForbidden =
    "(^|[^A-Za-z0-9_.$}])/([w]ork|[h]ome|[r]oot)/"   // paths of one machine
    "|registry[.][a-z0-9-]+[.](org|com|net|io|dev)"  // package registries
    "|(npmjs|pypi|deb[.]debian|snapshot[.]debian)[.](org|com)"
    "|\"resolved\": *\"http";  // a lock file's download address

// "line: text" for every forbidden piece of a file.
std::vector<std::string> ForbiddenText(const std::string& text) {
  static const std::regex pattern(kForbidden, std::regex::optimize);
  std::vector<std::string> found;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) {
      found.push_back(std::to_string(number) + ": " + match.str());
    }
  }
  return found;
}

// The files that git tracks below `top`; empty where this is no checkout.
std::vector<fs::path> TrackedFiles(const fs::path& top) {
  const std::string command = "git -c safe.directory='" + top.string() + "' -C '" + top.string() +
                              "' ls-files -z 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) {
    output.append(buffer.data(), count);
  }
  std::vector<fs::path> files;
  for (std::size_t begin = 0; begin < output.size();) {
    const std::size_t end = output.find('\0', begin);
    files.push_back(top / output.substr(begin, end - begin));
    begin = end + 1;
  }
  return files;
}

TEST(TrackedTextLint, FindsMachinePathsAndRegistries) {
  const std::string slash = "/", dot = ".",
                    quote = "\"";  // or this file would hold what it forbids
  EXPECT_THAT(ForbiddenText("a\nsee " + slash + "home/me/x and\n"),
              ElementsAre("2:  " + slash + "home/"));
  EXPECT_THAT(ForbiddenText(slash + "work/a"), ElementsAre("1: " + slash + "work/"));
  EXPECT_THAT(ForbiddenText(quote + "resolved" + quote + ": " + quote + "https://x/y.tgz"),
              SizeIs(1));
  EXPECT_THAT(ForbiddenText("https://registry" + dot + "example.org/x"), SizeIs(1));
  EXPECT_THAT(ForbiddenText("http://deb" + dot + "debian.org/"), SizeIs(1));
}

TEST(TrackedTextLint, LeavesInnocentTextAlone) {
  EXPECT_THAT(ForbiddenText("speed/work/time, $HOME/x, out/home/, registry.cpp, registry.h\n"
                            "mocap.cs.cmu.edu, the registry. Then\n"),
              IsEmpty());
}

TEST(TrackedText, NamesNoMachineAndNoRegistry) {
  const fs::path top = VITRUVIA_SOURCE_DIR;
  const std::vector<fs::path> files = TrackedFiles(top);
  if (files.empty()) GTEST_SKIP() << top << " is no git checkout";
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(file)) continue;  // deleted but not yet committed
    const std::string text = ReadWholeFile(file);
    if (text.find('\0') != std::string::npos) continue;  // a picture or the like
    EXPECT_THAT(ForbiddenText(text), IsEmpty()) << file.lexically_relative(top);
  }
}

}  // namespace
}  // namespace vitruvia
