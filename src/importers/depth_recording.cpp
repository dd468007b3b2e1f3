#include "importers/depth_recording.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/files.h"
#include "geometry/image_file.h"
#include "geometry/text_lines.h"
#include "math/statistics.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kMostMissing = 1e5;  // more is another numbering, not a gap

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// The number that begins at `at` without leading zeros, and the place behind it.
std::string_view NumberAt(const std::string& text, std::size_t& at) {
  while (at < text.size() && text[at] == '0') ++at;
  const std::size_t begin = at;
  while (at < text.size() && IsDigit(text[at])) ++at;
  return std::string_view(text).substr(begin, at - begin);
}

// Numbers in names by their value: frame2 comes before frame10.
bool NaturallyBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string_view x = NumberAt(a, i), y = NumberAt(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

// The last number of a name, and what stands before it.
struct NumberedName {
  std::string prefix;
  std::optional<std::int64_t> number;
};

NumberedName Numbered(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::size_t end = stem.size();
  while (end > 0 && !IsDigit(stem[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && IsDigit(stem[begin - 1])) --begin;
  return {stem.substr(0, begin), ParseInteger(stem.substr(begin, end - begin))};
}

// What counts frames: numbers in names or time stamps, one for each file.
struct NumberedFiles {
  std::vector<fs::path> files;
  std::vector<double> positions;  // empty: nothing counts them
};

std::vector<fs::path> FilesIn(const fs::path& folder) {
  std::vector<fs::path> images, clouds;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_regular_file()) continue;
    if (IsImageFile(entry.path())) images.push_back(entry.path());
    if (IsPcdFile(entry.path())) clouds.push_back(entry.path());
  }
  if (images.empty() && clouds.empty()) {
    throw DataError(
        fmt::format("{}: expected a folder of .png, .pgm, .tif, .exr or .pcd files, found none",
                    folder.string()));
  }
  if (!images.empty() && !clouds.empty())
    throw DataError(fmt::format("{}: holds {} images and {} .pcd files; expected one kind",
                                folder.string(), images.size(), clouds.size()));
  std::vector<fs::path> files = images.empty() ? clouds : images;
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturallyBefore(a.filename().string(), b.filename().string());
  });
  return files;
}

NumberedFiles NumberedFilesIn(const fs::path& folder) {
  NumberedFiles numbered{FilesIn(folder), {}};
  const std::string prefix = Numbered(numbered.files.front()).prefix;
  for (const fs::path& file : numbered.files) {
    const NumberedName name = Numbered(file);
    if (!name.number || name.prefix != prefix) return {numbered.files, {}};
    numbered.positions.push_back(static_cast<double>(*name.number));
  }
  return numbered;
}

NumberedFiles NumberedFilesOf(const fs::path& list) {
  const std::string content = ReadWholeFile(list);
  TextLines lines(content, list.string());
  NumberedFiles numbered;
  while (lines.Next()) {
    const std::vector<std::string_view> words = lines.Words();
    if (words.empty() || words[0].starts_with('#')) continue;
    const auto time_s = ParseNumber(words[0]);
    if (words.size() != 2 || !time_s || !std::isfinite(*time_s))
      lines.Fail(fmt::format("expected \"seconds path\", got \"{}\"", lines.text().substr(0, 80)));
    if (!numbered.positions.empty() && *time_s <= numbered.positions.back())
      lines.Fail(fmt::format("time stamp {} does not come after {} of the frame before it",
                             words[0], numbered.positions.back()));
    const fs::path file = list.parent_path() / words[1];
    if (!fs::is_regular_file(file))
      lines.Fail(fmt::format("expected a file at {}, there is none", file.string()));
    numbered.files.push_back(file);
    numbered.positions.push_back(*time_s);
  }
  if (numbered.files.empty())
    throw DataError(fmt::format("{}: expected lines \"seconds path\", found none", list.string()));
  return numbered;
}

// The usual step from one frame to the next; 0 where nothing tells.
double UsualStep(const std::vector<double>& positions) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < positions.size(); ++i)
    steps.push_back(positions[i] - positions[i - 1]);
  return steps.empty() ? 0.0 : Quantile(steps, 0.5);
}

DepthRecording WithGaps(const NumberedFiles& numbered) {
  const double step = UsualStep(numbered.positions);
  DepthRecording recording;
  for (std::size_t i = 0; i < numbered.files.size(); ++i) {
    if (i > 0 && step > 0.0) {
      const double missing =
          std::round((numbered.positions[i] - numbered.positions[i - 1]) / step) - 1.0;
      if (missing > 0.0 && missing < kMostMissing) {
        recording.gaps.push_back(fmt::format("{} between {} and {}", static_cast<int>(missing),
                                             numbered.files[i - 1].filename().string(),
                                             numbered.files[i].filename().string()));
        recording.missing += static_cast<int>(missing);
        recording.frames.resize(recording.frames.size() + static_cast<std::size_t>(missing));
      }
    }
    recording.frames.push_back(numbered.files[i]);
  }
  return recording;
}

// Images beside those of a list that it does not name, for people; "" if there are none.
std::string Unlisted(std::vector<fs::path> listed, const fs::path& list) {
  const fs::path folder = listed.front().parent_path();
  std::vector<fs::path> unlisted;
  std::sort(listed.begin(), listed.end());
  for (const fs::path& file : FilesIn(folder)) {
    if (!std::binary_search(listed.begin(), listed.end(), file)) unlisted.push_back(file);
  }
  if (unlisted.empty()) return "";
  return fmt::format("{} files of {} are not in {}, {} the first of them", unlisted.size(),
                     folder.string(), list.filename().string(),
                     unlisted.front().filename().string());
}

}  // namespace

bool IsPcdFile(const fs::path& file) { return file.extension() == ".pcd"; }

DepthRecording FindRecordedFrames(const fs::path& images) {
  if (fs::is_directory(images)) return WithGaps(NumberedFilesIn(images));
  if (!fs::is_regular_file(images)) {
    throw DataError(fmt::format(
        "{}: expected a folder of depth images, a list of them or one of them; there is nothing",
        images.string()));
  }
  if (IsImageFile(images) || IsPcdFile(images)) return WithGaps({{images}, {}});
  const NumberedFiles numbered = NumberedFilesOf(images);
  DepthRecording recording = WithGaps(numbered);
  if (const std::string unlisted = Unlisted(numbered.files, images); !unlisted.empty())
    recording.gaps.push_back(unlisted);
  const double step_s = UsualStep(numbered.positions);
  if (step_s > 0.0) recording.fps = 1.0 / step_s;
  return recording;
}

}  // namespace vitruvia
