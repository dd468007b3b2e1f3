#include "importers/depth_import.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/worker_team.h"
#include "cutout/packed_labels.h"
#include "cutout/sheet.h"
#include "importers/checked_sequence.h"
#include "importers/depth_frames.h"
#include "importers/depth_recording.h"
#include "math/evenly_spread.h"
#include "math/statistics.h"
#include "sequence/sequence.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr double kUsualFps = 30.0;
constexpr double kNearestRoom_m = 0.2, kFarthestRoom_m = 20.0;  // median depth of a recording
constexpr std::size_t kEveryPixel = 97;                         // looked at for that median
constexpr double kOtherUnit = 5.0;      // factor of a frame's median depth that nobody causes
constexpr int kBatch = 16;              // frames that are worked on together
constexpr int kSheetFrames = 12;        // of the preview
constexpr int kNamedUnsureFrames = 50;  // in the provenance

// The files of a recording in the order of its frames; empty where one is missing.
struct Frames {
  std::vector<fs::path> files;
  double fps = 0.0;
  int missing = 0;
  std::vector<std::string> gaps;
};

void RequireRange(const FrameRange& range, std::size_t frames, const fs::path& images) {
  if (static_cast<std::size_t>(range.first) + static_cast<std::size_t>(std::max(1, range.count)) <=
      frames)
    return;
  throw DataError(fmt::format("{}: frames: first is {} and count {}, but there are {} frames",
                              images.string(), range.first, range.count, frames));
}

Frames ChosenFrames(const DepthImportSettings& s) {
  const DepthRecording recording = FindRecordedFrames(s.images);
  Frames frames{recording.frames, s.fps, 0, recording.gaps};
  if (frames.fps == 0.0) frames.fps = recording.fps > 0.0 ? recording.fps : kUsualFps;
  if (s.missing_frames == MissingFrames::kSkip)
    std::erase_if(frames.files, [](const fs::path& file) { return file.empty(); });
  RequireRange(s.frames, frames.files.size(), s.images);
  const auto first = frames.files.begin() + s.frames.first;
  frames.files = {first, s.frames.count > 0 ? first + s.frames.count : frames.files.end()};
  frames.missing = static_cast<int>(std::count(frames.files.begin(), frames.files.end(), ""));
  return frames;
}

std::vector<fs::path> FilesWithoutPerson(const DepthImportSettings& s) {
  if (s.cutout.background.source != BackgroundSource::kEmptyFrames) return {};
  const fs::path& images = s.empty_frames.images.empty() ? s.images : s.empty_frames.images;
  std::vector<fs::path> files = FindRecordedFrames(images).frames;
  std::erase_if(files, [](const fs::path& file) { return file.empty(); });
  RequireRange({s.empty_frames.first, s.empty_frames.count}, files.size(), images);
  const auto first = files.begin() + s.empty_frames.first;
  return {first, s.empty_frames.count > 0 ? first + s.empty_frames.count : files.end()};
}

std::string NumbersOf(const std::vector<fs::path>& files) {
  const auto first =
      std::find_if(files.begin(), files.end(), [](const fs::path& file) { return !file.empty(); });
  return first == files.end() ? "" : StoredNumbers(*first);
}

// Reads frames of one recording, whose files all store the same kind of numbers, on all threads.
class FrameReader {
 public:
  FrameReader(const DepthImportSettings& s, const std::vector<fs::path>& files, WorkerTeam& team)
      : stored_{s.camera.AsCamera(), s.unit_m, s.invalid, s.orientation, NumbersOf(files)},
        camera_(OrientedCamera(stored_.camera, s.orientation)),
        team_(team) {}

  const PinholeCamera& camera() const { return camera_; }

  DepthImage Read(const fs::path& file) const {
    return file.empty() ? DepthImage(camera_.width, camera_.height) : ReadDepthFrame(file, stored_);
  }

  // The first existing file is read first, so that an error common to all files is reported for
  // this one.
  std::vector<DepthImage> ReadSample(const std::vector<fs::path>& files, int count) const {
    const auto first = std::find_if(files.begin(), files.end(),
                                    [](const fs::path& file) { return !file.empty(); });
    if (first != files.end()) Read(*first);
    const std::vector<int> chosen = EvenlySpread(static_cast<int>(files.size()), count);
    std::vector<DepthImage> images(chosen.size());
    team_.For(static_cast<int>(chosen.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        images[static_cast<std::size_t>(i)] =
            Read(files[static_cast<std::size_t>(chosen[static_cast<std::size_t>(i)])]);
    });
    return images;
  }

 private:
  StoredDepth stored_;
  PinholeCamera camera_;
  WorkerTeam& team_;
};

// Measured depths of some pixels.
void AddDepths(const DepthImage& image, std::size_t every_pixel, std::vector<double>& depths) {
  for (std::size_t i = 0; i < image.pixels().size(); i += every_pixel) {
    if (image.pixels()[i] > 0.0f) depths.push_back(image.pixels()[i]);
  }
}

std::vector<double> DepthsOf(const std::vector<DepthImage>& images, std::size_t every_pixel) {
  std::vector<double> depths;
  for (const DepthImage& image : images) AddDepths(image, every_pixel, depths);
  return depths;
}

// Least and largest measured depth; 0 for the largest where nothing is measured.
std::pair<float, float> DepthRange(const std::vector<DepthImage>& images) {
  float least = std::numeric_limits<float>::infinity(), most = 0.0f;
  for (const DepthImage& image : images) {
    for (const float z : image.pixels()) {
      if (z > 0.0f) least = std::min(least, z);
      most = std::max(most, z);
    }
  }
  return {least, most};
}

// 0 where nothing is measured.
double MedianDepth(const DepthImage& image) {
  std::vector<double> depths;
  AddDepths(image, kEveryPixel, depths);
  return depths.empty() ? 0.0 : Quantile(depths, 0.5);
}

// Depth in a wrong unit is the most likely mistake, and would cause later steps to fail with
// misleading messages.
void RequireRoom(const std::vector<DepthImage>& sample, const DepthImportSettings& s) {
  std::vector<double> depths = DepthsOf(sample, kEveryPixel);
  if (depths.empty()) depths = DepthsOf(sample, 1);
  const std::string where = s.images.string();
  if (depths.empty()) {
    throw DataError(fmt::format(
        "{}: none of {} frames looked at holds a measurement: every pixel is 0, not finite or one "
        "of `invalid`; is this a recording of empty frames?",
        where, sample.size()));
  }
  const double median_m = Quantile(depths, 0.5);
  if (median_m >= kNearestRoom_m && median_m <= kFarthestRoom_m) return;
  const double factor = std::pow(10.0, -std::round(std::log10(median_m / 2.0)));
  throw DataError(fmt::format(
      "{}: the median depth is {:.4g} m, expected {} to {} m; the stored value is {:.5g} and "
      "`unit_m` {:g}; is `unit_m` {:g} meant?",
      where, median_m, kNearestRoom_m, kFarthestRoom_m, median_m / s.unit_m, s.unit_m,
      s.unit_m * factor));
}

// Without a measurement in any of them the room would not be known, and nothing would say so.
void RequireEmptyRoom(const std::vector<DepthImage>& empty, const DepthImportSettings& s) {
  if (s.cutout.background.source != BackgroundSource::kEmptyFrames) return;
  const fs::path& images = s.empty_frames.images.empty() ? s.images : s.empty_frames.images;
  const auto [least_m, most_m] = DepthRange(empty);
  if (most_m == 0.0f) {
    throw DataError(fmt::format(
        "{}: empty_frames: none of {} frames looked at holds a measurement; expected images of the "
        "room without a person, which cutout.background.source empty_frames learns the room from",
        images.string(), empty.size()));
  }
  if (least_m != most_m || least_m <= s.cutout.far_m) return;
  throw DataError(fmt::format(
      "{}: empty_frames: every pixel of {} frames looked at lies at {:.4g} m, beyond cutout.far_m "
      "({:g} m), so that no room is known; is the stored value {:.5g} the camera's mark for no "
      "measurement, which belongs in `invalid`?",
      images.string(), empty.size(), least_m, s.cutout.far_m, least_m / s.unit_m));
}

SequenceInfo InfoOf(const DepthImportSettings& s, const Frames& frames,
                    const PinholeCamera& camera) {
  SequenceInfo info;
  info.camera = camera;
  info.depth_unit_m = s.depth_unit_m;
  info.fps = frames.fps;
  info.frames = static_cast<int>(frames.files.size());
  info.surface = false;
  info.subject = !s.subject.empty();
  info.provenance = {{"made_by", "vitruvia import"},
                     {"import", WriteSettings(s)},
                     {"missing_frames", frames.missing},
                     {"gaps", frames.gaps},
                     {"build", Provenance()}};
  return info;
}

// What was found in a recording, frame by frame.
struct FollowedRecording {
  std::vector<FollowedPerson> people;
  std::vector<PackedLabels> labels;             // of people, of each frame
  std::vector<std::vector<int>> foreign_depth;  // of each frame (outline.h)
  std::vector<double> median_depths_m;          // of each frame; 0 where nothing is measured
  int at_pixel = 0;                             // who is at the pixel of the settings
  double largest_piece_m2 = 0.0, tallest_piece_m = 0.0;

  OutlinedPeople PeopleIn(std::size_t frame) const {
    return {Unpacked(labels[frame]), foreign_depth[frame]};
  }
};

int PersonAt(const Image<std::uint8_t>& people, const PersonSettings& pixel) {
  return people.Contains(pixel.u, pixel.v) ? people(pixel.u, pixel.v) : 0;
}

// Follows the people of a recording, some frames at a time.
class RecordingFollower {
 public:
  RecordingFollower(const FrameReader& reader, const Room& room, const CutoutSettings& settings,
                    double fps, WorkerTeam& team)
      : reader_(reader),
        room_(room),
        settings_(settings),
        team_(team),
        people_(room, settings, fps) {}

  // Of the files that come next; returns their depth.
  std::vector<DepthImage> Follow(std::span<const fs::path> files) {
    std::vector<DepthImage> depths(files.size());
    std::vector<Pieces> pieces(files.size());
    team_.For(static_cast<int>(files.size()), 1, [&](int begin, int) {
      const auto i = static_cast<std::size_t>(begin);
      depths[i] = reader_.Read(files[i]);
      pieces[i] = PiecesOf(depths[i], room_, settings_);
    });
    std::vector<Image<std::uint8_t>> people(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) people[i] = Add(depths[i], pieces[i]);
    const std::size_t first = found_.labels.size();
    found_.labels.resize(first + files.size());
    found_.foreign_depth.resize(first + files.size());
    team_.For(static_cast<int>(files.size()), 1, [&](int begin, int) {
      const auto i = static_cast<std::size_t>(begin);
      OutlinedPeople outlined = SmoothOutlines(depths[i], pieces[i], room_, settings_, people[i]);
      found_.labels[first + i] = Pack(outlined.people);
      found_.foreign_depth[first + i] = std::move(outlined.foreign_depth);
    });
    return depths;
  }

  FollowedRecording Result() {
    found_.people = people_.people();
    return std::move(found_);
  }

 private:
  // Follows the people into the next frame; returns the number of the person at each pixel.
  Image<std::uint8_t> Add(const DepthImage& depth, const Pieces& pieces) {
    Image<std::uint8_t> people = people_.Follow(depth, pieces);
    found_.median_depths_m.push_back(MedianDepth(depth));
    if (frames_++ == settings_.person.frame) found_.at_pixel = PersonAt(people, settings_.person);
    if (!pieces.pieces.empty()) {
      const Piece& largest = pieces.pieces.front();
      found_.largest_piece_m2 = std::max(found_.largest_piece_m2, largest.area_m2);
      found_.tallest_piece_m = std::max(found_.tallest_piece_m, double{largest.height_m()});
    }
    return people;
  }

  const FrameReader& reader_;
  const Room& room_;
  const CutoutSettings& settings_;
  WorkerTeam& team_;
  PeopleFollower people_;
  int frames_ = 0;
  FollowedRecording found_;
};

// Writes the depth of all frames and follows the people in them.
FollowedRecording FollowAndWrite(std::span<const fs::path> files, RecordingFollower& follower,
                                 WorkerTeam& team, SequenceWriter& writer, Progress& progress) {
  for (std::size_t first = 0; first < files.size(); first += kBatch) {
    const auto batch = files.subspan(first, std::min<std::size_t>(kBatch, files.size() - first));
    writer.Append(follower.Follow(batch), team);
    progress.Advance(static_cast<int>(batch.size()));
  }
  return follower.Result();
}

// The likely reason why no piece has a person's size.
std::string WhyNobody(const FollowedRecording& found, const Room& room,
                      const DepthImportSettings& s) {
  if (found.tallest_piece_m > s.cutout.person.size.most_height_m) {
    return fmt::format(
        "Are the focal lengths those of the images (camera: fx {:g}, fy {:g}), and does the "
        "background hold the room (cutout.background), so that the person is not one with it?",
        s.camera.fx, s.camera.fy);
  }
  const std::string with_floor =
      room.floor ? fmt::format(
                       ", or was the person removed with the floor (cutout.floor), {:.2f} m under "
                       "the camera, tilted {:.1f} degrees",
                       room.floor->height_m, room.floor->TiltDegrees())
                 : "";
  return fmt::format(
      "Does the person stand still all the time, so that they count as background "
      "(cutout.background), or beyond far_m ({:g} m){}?",
      s.cutout.far_m, with_floor);
}

ChosenPerson RequirePerson(const FollowedRecording& found, const Room& room,
                           const DepthImportSettings& s) {
  const PersonSettings& person = s.cutout.person;
  if (const auto chosen = ChoosePerson(found.people, person, found.at_pixel)) return *chosen;
  const std::string where = s.images.string();
  if (!found.people.empty()) {
    throw DataError(fmt::format(
        "{}: cutout.person: nobody is at column {}, row {} of frame {}; {} people are seen in the "
        "recording",
        where, person.u, person.v, person.frame, found.people.size()));
  }
  throw DataError(fmt::format(
      "{}: no person is found in any of {} frames: in front of the room the largest piece has "
      "{:.2g} m², the largest pieces are up to {:.2g} m high; expected at least {:g} m² and {:g} "
      "to {:g} m (cutout.person.size). {}",
      where, found.labels.size(), found.largest_piece_m2, found.tallest_piece_m,
      person.size.least_area_m2, person.size.least_height_m, person.size.most_height_m,
      WhyNobody(found, room, s)));
}

// Names frames whose depths are several times those of the recording.
void AddOtherUnits(const std::vector<double>& median_depths_m, CutoutReport& report) {
  std::vector<double> measured = median_depths_m;
  std::erase(measured, 0.0);
  const double usual_m = measured.empty() ? 0.0 : Quantile(measured, 0.5);
  for (std::size_t i = 0; i < median_depths_m.size(); ++i) {
    const double depth_m = median_depths_m[i];
    if (depth_m == 0.0 || (depth_m < usual_m * kOtherUnit && depth_m > usual_m / kOtherUnit))
      continue;
    report.AddUnsure(static_cast<int>(i),
                     fmt::format("its median depth is {:.3g} m, {:.3g} m in the recording: has it "
                                 "another unit?",
                                 depth_m, usual_m));
  }
}

// Writes all masks; returns each one's share of the image.
std::vector<double> WriteMasks(const FollowedRecording& found, const ChosenPerson& chosen,
                               const SequenceWriter& writer, WorkerTeam& team) {
  std::vector<double> shares(found.labels.size());
  team.For(static_cast<int>(shares.size()), 1, [&](int begin, int) {
    const auto i = static_cast<std::size_t>(begin);
    const MaskImage mask = MaskOf(found.PeopleIn(i), chosen);
    const auto out = std::count(mask.pixels().begin(), mask.pixels().end(), 0);
    shares[i] = 1.0 - static_cast<double>(out) / static_cast<double>(mask.pixels().size());
    writer.WriteMask(begin, mask);
  });
  return shares;
}

// Frames spread over the recording, half of them unsure ones where there are so many.
std::vector<int> FramesToShow(int frames, const CutoutReport& report) {
  std::vector<int> shown;
  const auto unsure = static_cast<int>(report.unsure.size());
  for (const int i : EvenlySpread(unsure, std::min(unsure, kSheetFrames / 2)))
    shown.push_back(report.unsure[static_cast<std::size_t>(i)].frame);
  for (const int i : EvenlySpread(frames, kSheetFrames - static_cast<int>(shown.size())))
    shown.push_back(i);
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return shown;
}

std::string Sheet(const FrameReader& reader, const std::vector<fs::path>& files,
                  const FollowedRecording& found, const ChosenPerson& chosen,
                  const CutoutReport& report) {
  std::vector<SheetFrame> shown;
  for (const int i : FramesToShow(static_cast<int>(files.size()), report)) {
    const auto at = static_cast<std::size_t>(i);
    const bool is_unsure = std::any_of(report.unsure.begin(), report.unsure.end(),
                                       [i](const UnsureFrame& frame) { return frame.frame == i; });
    shown.push_back({i, reader.Read(files[at]), Unpacked(found.labels[at]), is_unsure});
  }
  return CutoutSheet(shown, chosen);
}

Json NoteOf(const DepthImport& result) {
  Json unsure = Json::array();
  for (const UnsureFrame& frame : result.cut.unsure) {
    if (unsure.size() < kNamedUnsureFrames)
      unsure.push_back({{"frame", frame.frame}, {"why", frame.why}});
  }
  Json note = {{"people", result.people},
               {"chosen", result.chosen.numbers},
               {"frames_without_person", result.cut.frames_without_person},
               {"area_jumps", result.cut.area_jumps},
               {"pixel_share", result.cut.pixel_share},
               {"area_m2", result.cut.area_m2},
               {"noise_at_1m_m", result.room.noise_at_1m_m},
               {"unsure_frames", result.cut.unsure.size()},
               {"unsure", unsure}};
  if (const auto& floor = result.room.floor) {
    note["floor"] = {{"up", {floor->up.x(), floor->up.y(), floor->up.z()}},
                     {"camera_height_m", floor->height_m},
                     {"share", floor->share}};
  }
  return note;
}

}  // namespace

DepthImport ImportDepthSequence(const DepthImportSettings& s, int threads, const fs::path& folder) {
  std::optional<BodyModel> subject;
  if (!s.subject.empty()) subject = ReadBodyModel(s.subject);
  const Frames frames = ChosenFrames(s);
  WorkerTeam team(threads);
  const FrameReader reader(s, frames.files, team);
  const int samples = s.cutout.background.samples;
  const std::vector<DepthImage> sample = reader.ReadSample(frames.files, samples);
  RequireRoom(sample, s);
  const std::vector<fs::path> without_person = FilesWithoutPerson(s);
  const std::vector<DepthImage> empty =
      FrameReader(s, without_person, team).ReadSample(without_person, samples);
  RequireEmptyRoom(empty, s);

  DepthImport result;
  result.camera = reader.camera();
  result.fps = frames.fps;
  result.frames = static_cast<int>(frames.files.size());
  result.missing = frames.missing;
  result.gaps = frames.gaps;
  result.room = LearnRoom(sample, empty, reader.camera(), s.cutout);
  SequenceWriter writer(folder, InfoOf(s, frames, reader.camera()), subject);
  FollowedRecording found;
  {
    Progress progress("import " + folder.filename().string(), result.frames);
    RecordingFollower follower(reader, result.room, s.cutout, frames.fps, team);
    found = FollowAndWrite(frames.files, follower, team, writer, progress);
  }
  result.people = static_cast<int>(found.people.size());
  result.chosen = RequirePerson(found, result.room, s);
  const std::vector<double> shares = WriteMasks(found, result.chosen, writer, team);
  result.cut = ReportCutout(found.people, result.chosen, shares, s.cutout.following);
  AddOtherUnits(found.median_depths_m, result.cut);
  writer.WritePreview(Sheet(reader, frames.files, found, result.chosen, result.cut));
  writer.Note("cutout", NoteOf(result));
  PublishChecked(writer, folder, {}, threads);
  return result;
}

}  // namespace vitruvia
