#include "reports/pictures/drawn_before.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/build_info.h"
#include "core/files.h"
#include "core/hash.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr const char* kFile = "drawn.cbor";

// By names, sizes and times of the files: their content is written whole or not at all.
void AddFiles(const fs::path& place, Hash64& hash) {
  std::vector<std::string> files;
  const auto add = [&](const fs::path& file) {
    if (fs::is_regular_file(file))
      files.push_back(fmt::format("{} {} {}\n", file.filename().string(), fs::file_size(file),
                                  fs::last_write_time(file).time_since_epoch().count()));
  };
  if (fs::is_directory(place)) {
    for (const auto& entry : fs::directory_iterator(place)) add(entry.path());
  } else {
    add(place);
  }
  std::ranges::sort(files);
  for (const std::string& file : files) hash.Add(file);
  hash.Add("\n");
}

std::string DigestOf(const ReportedExperiment& experiment, const RunRecord& run) {
  const fs::path folder = experiment.folder / run.run_id;
  Hash64 hash;
  hash.Add(GetBuildInfo().build_id);
  for (const char* part : {"record.json", "tree.json", "estimate", "surfaces"})
    AddFiles(folder / part, hash);
  hash.Add(run.sequence_hash);
  AddFiles(experiment.folder / run.sequence_folder, hash);
  hash.Add(fmt::format("{}", fmt::join(experiment.record.picture_frames, " ")));
  return hash.Hex();
}

Json ToJson(const Picture& picture) {
  return Json::binary({picture.png.begin(), picture.png.end()});
}
Picture PictureFrom(const Json& json) {
  const auto& bytes = json.get_binary();
  Picture picture;
  picture.png.assign(bytes.begin(), bytes.end());
  return picture;
}

Json ToJson(const std::vector<Picture>& pictures) {
  Json list = Json::array();
  for (const Picture& picture : pictures) list.push_back(ToJson(picture));
  return list;
}
std::vector<Picture> PicturesFrom(const Json& json) {
  std::vector<Picture> pictures;
  for (const Json& picture : json) pictures.push_back(PictureFrom(picture));
  return pictures;
}

Json ToJson(const RunPictures& run) {
  Json keys = Json::array(), strips = Json::array();
  for (const ColorKey& key : run.keys) keys.push_back({key.color, key.meaning});
  for (const PictureStrip& strip : run.strips) {
    strips.push_back({strip.label, strip.sublabel, strip.note, strip.frame, strip.error_mean_m,
                      strip.error_max_m, ToJson(strip.pictures)});
  }
  return {{"id", run.run_id},
          {"problem", run.problem},
          {"titles", run.titles},
          {"depth", {run.nearest_m, run.farthest_m}},
          {"error_scale", {run.error_scale_m, run.own_error_scale_m}},
          {"keys", keys},
          {"strips", strips}};
}
RunPictures RunPicturesFrom(const Json& json) {
  RunPictures run;
  run.run_id = json.at("id");
  run.problem = json.at("problem");
  run.titles = json.at("titles").get<std::vector<std::string>>();
  run.nearest_m = json.at("depth").at(0);
  run.farthest_m = json.at("depth").at(1);
  run.error_scale_m = json.at("error_scale").at(0);
  run.own_error_scale_m = json.at("error_scale").at(1);
  for (const Json& key : json.at("keys"))
    run.keys.push_back({key.at(0).get<Color>(), key.at(1).get<std::string>()});
  for (const Json& strip : json.at("strips")) {
    run.strips.push_back({strip.at(0).get<std::string>(), strip.at(1).get<std::string>(),
                          strip.at(2).get<std::string>(), strip.at(3).get<int>(),
                          strip.at(4).get<double>(), strip.at(5).get<double>(),
                          PicturesFrom(strip.at(6))});
  }
  return run;
}

Json ToJson(const RunCauses& run) {
  Json events = Json::array();
  for (const ErrorEvent& event : run.diagnosis.events) {
    events.push_back({event.first, event.last, event.worst, static_cast<int>(event.cause),
                      event.share, event.reason});
  }
  return {{"id", run.run_id},
          {"problem", run.problem},
          {"shares", run.diagnosis.shares},
          {"events", events},
          {"lost", run.diagnosis.lost_frames},
          {"pictures", ToJson(run.pictures)}};
}
RunCauses RunCausesFrom(const Json& json) {
  RunCauses run;
  run.run_id = json.at("id");
  run.problem = json.at("problem");
  run.diagnosis.shares = json.at("shares").get<decltype(run.diagnosis.shares)>();
  for (const Json& event : json.at("events")) {
    run.diagnosis.events.push_back({event.at(0).get<int>(), event.at(1).get<int>(),
                                    event.at(2).get<int>(),
                                    static_cast<Cause>(event.at(3).get<int>()),
                                    event.at(4).get<double>(), event.at(5).get<std::string>()});
  }
  run.diagnosis.lost_frames = json.at("lost").get<std::vector<int>>();
  run.pictures = PicturesFrom(json.at("pictures"));
  return run;
}

bool HasSheet(const fs::path& folder, const RunPictures& run) {
  return run.strips.empty() || (fs::exists(SheetStem(folder, run.run_id).concat(".svg")) &&
                                fs::exists(SheetStem(folder, run.run_id).concat(".png")));
}

template <class Value>
const Value* Found(const std::map<std::string, Value>& values, const std::string& id) {
  const auto found = values.find(id);
  return found == values.end() ? nullptr : &found->second;
}

}  // namespace

DrawnBefore::DrawnBefore(const ReportedExperiment& experiment, const fs::path& folder) {
  Hash64 all;
  AddFiles(experiment.folder / "experiment.json", all);
  for (const RunRecord* run : experiment.finished()) {
    digests_[run->run_id] = DigestOf(experiment, *run);
    all.Add(run->run_id + digests_[run->run_id]);
  }
  digest_of_all_ = all.Hex();
  if (!fs::exists(folder / kFile)) return;
  try {
    Read(folder);
  } catch (const Json::exception&) {  // damaged: all is drawn anew
    pictures_.clear();
    causes_.clear();
  }
}

void DrawnBefore::Read(const fs::path& folder) {
  const Json drawn = Json::from_cbor(ReadWholeFile(folder / kFile));
  const auto holds = [&](const Json& entry) {
    return entry.at("digest") == DigestFor(entry.at("id").get<std::string>());
  };
  for (const Json& entry : drawn.at("pictures")) {
    if (!holds(entry)) continue;
    RunPictures run = RunPicturesFrom(entry);
    if (HasSheet(folder, run)) pictures_[run.run_id] = std::move(run);
  }
  for (const Json& entry : drawn.at("causes")) {
    if (holds(entry)) causes_[entry.at("id").get<std::string>()] = RunCausesFrom(entry);
  }
}

std::string DrawnBefore::DigestFor(const std::string& id) const {
  const std::string* own = Found(digests_, id);
  return own == nullptr ? digest_of_all_ : *own;
}

const RunPictures* DrawnBefore::Pictures(const std::string& id) const {
  return Found(pictures_, id);
}

const RunCauses* DrawnBefore::Causes(const std::string& run_id) const {
  return Found(causes_, run_id);
}

void DrawnBefore::Keep(const std::vector<RunPictures>& pictures,
                       const std::vector<RunCauses>& causes, const fs::path& folder) const {
  Json drawn = {{"pictures", Json::array()}, {"causes", Json::array()}};
  const auto add = [&](const auto& run, const char* list) {
    Json entry = ToJson(run);
    entry["digest"] = DigestFor(run.run_id);
    drawn[list].push_back(std::move(entry));
  };
  for (const RunPictures& run : pictures) add(run, "pictures");
  for (const RunCauses& run : causes) add(run, "causes");
  const std::vector<std::uint8_t> bytes = Json::to_cbor(drawn);
  WriteWholeFile(folder / kFile, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace vitruvia
