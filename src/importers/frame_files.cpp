#include "importers/frame_files.h"

#include <algorithm>
#include <cctype>
#include <compare>
#include <map>
#include <string_view>
#include <tuple>

#include "core/error.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostDigits = 18;  // that a difference of numbers can be computed of

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Digits without leading zeros: of any length, in the order of their values.
struct Number {
  std::string digits;

  std::strong_ordering operator<=>(const Number& other) const {
    return std::tuple(digits.size(), std::string_view(digits)) <=>
           std::tuple(other.digits.size(), std::string_view(other.digits));
  }
  bool operator==(const Number&) const = default;
};

struct NumberedFile {
  fs::path path;
  std::string pattern;  // the name with # for each number, its extension in small letters
  std::vector<Number> numbers;
};

NumberedFile Numbered(const fs::path& path) {
  NumberedFile file{path, "", {}};
  const std::string stem = path.stem().string();
  for (std::size_t i = 0; i < stem.size(); ++i) {
    if (!IsDigit(stem[i])) {
      file.pattern += stem[i];
      continue;
    }
    if (i == 0 || !IsDigit(stem[i - 1])) {
      file.pattern += '#';
      file.numbers.emplace_back();
    }
    std::string& digits = file.numbers.back().digits;
    if (stem[i] != '0' || !digits.empty()) digits += stem[i];
  }
  for (const char c : path.extension().string())
    file.pattern += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return file;
}

std::vector<NumberedFile> Candidates(const fs::path& folder,
                                     const std::function<bool(const fs::path&)>& is_frame,
                                     const std::vector<fs::path>& not_frames) {
  std::vector<NumberedFile> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    const bool is_hidden = path.filename().string().starts_with(".");
    const bool is_other = std::any_of(not_frames.begin(), not_frames.end(), [&](const auto& other) {
      std::error_code ignored;
      return fs::equivalent(path, other, ignored);
    });
    if (!is_hidden && !is_other && is_frame(path)) files.push_back(Numbered(path));
  }
  std::sort(files.begin(), files.end(), [](const NumberedFile& a, const NumberedFile& b) {
    return std::tie(a.numbers, a.path) < std::tie(b.numbers, b.path);
  });
  return files;
}

void RequireOnePattern(const std::vector<NumberedFile>& files, const fs::path& folder) {
  std::map<std::string, std::vector<const NumberedFile*>> kinds;
  for (const NumberedFile& file : files) kinds[file.pattern].push_back(&file);
  if (kinds.size() == 1) return;
  std::vector<std::string> examples;
  for (const auto& [pattern, of_kind] : kinds)
    examples.push_back(
        fmt::format("{} like {}", of_kind.size(), of_kind.front()->path.filename().string()));
  throw DataError(
      fmt::format("{}: cannot tell which files are frames: expected names that differ only in "
                  "their numbers, got {}",
                  folder.string(), fmt::join(examples, ", ")));
}

void RequireDifferentNumbers(const std::vector<NumberedFile>& files) {
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    if (files[i].numbers == files[i + 1].numbers)
      throw DataError(fmt::format("{}: has the same number as {}; expected one file for each frame",
                                  files[i + 1].path.string(), files[i].path.filename().string()));
  }
}

// The one number in which the names differ; empty if there are several or they are too long.
std::vector<long> FrameNumbers(const std::vector<NumberedFile>& files) {
  std::vector<long> frame_numbers;
  for (std::size_t place = 0; place < files.front().numbers.size(); ++place) {
    const bool differs = std::any_of(files.begin(), files.end(), [&](const NumberedFile& file) {
      return file.numbers[place] != files.front().numbers[place];
    });
    if (!differs) continue;
    if (!frame_numbers.empty()) return {};
    for (const NumberedFile& file : files) {
      const std::string& digits = file.numbers[place].digits;
      if (digits.size() > kMostDigits) return {};
      frame_numbers.push_back(digits.empty() ? 0 : std::stol(digits));
    }
  }
  return frame_numbers;
}

// Numbers that mostly have one distance, and sometimes a multiple of it.
std::string GapWarning(const std::vector<NumberedFile>& files, const fs::path& folder) {
  const std::vector<long> numbers = FrameNumbers(files);
  std::map<long, std::size_t> steps;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) ++steps[numbers[i + 1] - numbers[i]];
  if (steps.size() < 2) return "";
  const auto& [step, count] = *steps.begin();
  const bool is_counted = 2 * count >= numbers.size() - 1;
  if (!is_counted) return "";  // times, perhaps
  std::size_t gaps = 0, first = 0;
  long missing = 0;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) {
    if (numbers[i + 1] - numbers[i] == step) continue;
    if (gaps++ == 0) first = i;
    missing += (numbers[i + 1] - numbers[i]) / step - 1;
  }
  return fmt::format(
      "{}: the frames' numbers have {} gaps, the first from {} to {} ({} frames are missing): "
      "frames on both sides are taken as neighbours in time",
      folder.string(), gaps, files[first].path.filename().string(),
      files[first + 1].path.filename().string(), missing);
}

}  // namespace

FrameFiles FindFrameFiles(const fs::path& folder,
                          const std::function<bool(const fs::path&)>& is_frame,
                          const std::vector<fs::path>& not_frames, const std::string& expected) {
  const std::vector<NumberedFile> files = Candidates(folder, is_frame, not_frames);
  if (files.empty())
    throw DataError(
        fmt::format("{}: expected a folder of {}, found none", folder.string(), expected));
  RequireOnePattern(files, folder);
  RequireDifferentNumbers(files);
  FrameFiles found{{}, GapWarning(files, folder)};
  for (const NumberedFile& file : files) found.files.push_back(file.path);
  return found;
}

}  // namespace vitruvia
