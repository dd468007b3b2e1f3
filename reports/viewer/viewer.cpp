#include "reports/viewer/viewer.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "body/skeleton.h"
#include "core/files.h"
#include "core/progress.h"
#include "reports/drawing/color_maps.h"
#include "reports/drawing/html_text.h"
#include "reports/viewer/viewed_run.h"
#include "reports/viewer/viewer_assets.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

Json Ramp(Color (*color_of)(double)) {
  constexpr int kStops = 64;
  Json colors = Json::array();
  for (int i = 0; i < kStops; ++i)
    colors.push_back(color_of(static_cast<double>(i) / (kStops - 1)));
  return colors;
}

Json PaletteContent() {
  Json bones = Json::array();
  for (int bone = 0; bone < kBoneCount; ++bone) bones.push_back(BoneColor(bone));
  return {{"error", Ramp(ErrorColor)}, {"depth", Ramp(DepthColor)}, {"bones", bones},
          {"runs", kRunColors},        {"truth", kTruthColor},      {"estimate", kEstimateColor},
          {"failure", kFailureColor}};
}

Json BoneContent() {
  Json bones = Json::array();
  for (const BoneInfo& bone : Bones())
    bones.push_back({{"name", bone.name}, {"joint", bone.joint}, {"parent", bone.parent}});
  return bones;
}

int LongestRun(const std::vector<OpenedRun>& runs) {
  int longest = 0;
  for (const OpenedRun& run : runs) longest = std::max(longest, run.frame_count());
  return longest;
}

std::vector<int> WorstFrames(const std::vector<OpenedRun>& runs) {
  std::vector<int> frames;
  for (const OpenedRun& run : runs) {
    for (const ErrorEvent& event : run.diagnosis.events) frames.push_back(event.worst);
  }
  return frames;
}

// What the page leaves out.
Json Notes(const std::vector<OpenedRun>& runs, const PageFrame& page) {
  Json notes = Json::array();
  const int frames = LongestRun(runs);
  if (static_cast<int>(page.stored_frames.size()) < frames) {
    notes.push_back(fmt::format("Surfaces and depth are here for {} of {} frames.",
                                page.stored_frames.size(), frames));
  }
  for (const OpenedRun& run : runs) {
    const std::size_t vertices = run.estimate->rest_mesh().vertices.size();
    if (static_cast<int>(vertices) > page.most_vertices) {
      notes.push_back(fmt::format("{}: about {} of {} vertices are shown.", run.record.run_id,
                                  page.most_vertices, vertices));
    }
    if (!run.sequence->info().surface) {
      notes.push_back(
          fmt::format("{}: the sequence has no true surface with correspondences, so "
                      "there are no errors of vertices.",
                      run.record.run_id));
    }
  }
  return notes;
}

Json PageContent(const std::vector<OpenedRun>& runs, const PageFrame& page, PackedArrays& arrays) {
  Json sequences = Json::array(), run_contents = Json::array();
  std::map<fs::path, int> index_of_sequence;
  Progress progress("viewer", static_cast<int>(runs.size()));
  for (const OpenedRun& run : runs) {
    const auto [found, is_new] =
        index_of_sequence.try_emplace(run.sequence_folder, static_cast<int>(sequences.size()));
    if (is_new) sequences.push_back(SequenceContent(run, page, arrays));
    run_contents.push_back(RunContent(run, found->second, page, arrays));
    progress.Advance();
  }
  const Vector3f& origin = page.grid.origin;
  return {
      {"frames", LongestRun(runs)},
      {"stored_frames", page.stored_frames},
      {"grid", {{"origin", {origin.x(), origin.y(), origin.z()}}, {"step_m", page.grid.step_m}}},
      {"error_scale_m", page.error_scale_m},
      {"palette", PaletteContent()},
      {"bones", BoneContent()},
      {"notes", Notes(runs, page)},
      {"sequences", std::move(sequences)},
      {"runs", std::move(run_contents)}};
}

// Inside a script element only "</" would end it.
std::string ScriptJson(const Json& content) {
  std::string text = content.dump();
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3))
    text.replace(at, 2, "<\\/");
  return text;
}

std::string Page(const std::string& title, const Json& content, const PackedArrays& arrays) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{}</title><link rel=\"icon\" href=\"data:,\"><style>\n{}</style></head><body>\n",
      Escaped(title), kViewerStyle);
  html += kViewerBody;
  html += "<script type=\"application/json\" id=\"content\">" + ScriptJson(content) + "</script>\n";
  html += arrays.Html();
  html += "<!-- three.js, copyright 2010-2019 three.js authors, under the MIT licence -->\n";
  for (const char* script : {kThreeScript, kViewerDataScript, kViewerStageScript,
                             kViewerTimelineScript, kViewerScript}) {
    html += fmt::format("<script>\n{}</script>\n", script);
  }
  return html + "</body></html>\n";
}

std::string TitleOf(const std::vector<OpenedRun>& runs) {
  std::string title = runs.front().record.run_id;
  for (std::size_t i = 1; i < runs.size(); ++i) title += " · " + runs[i].record.run_id;
  return title;
}

}  // namespace

std::vector<int> StoredFrames(int count, int most, const std::vector<int>& wanted) {
  std::set<int> frames;
  const int spread = std::min(count, most);
  for (int i = 0; i < spread; ++i) {
    frames.insert(
        spread == 1 ? 0 : static_cast<int>(static_cast<long>(i) * (count - 1) / (spread - 1)));
  }
  for (const int frame : wanted) {
    if (frame >= 0 && frame < count) frames.insert(frame);
  }
  return {frames.begin(), frames.end()};
}

void WriteViewer(const std::vector<fs::path>& run_folders, const ViewerLimits& limits,
                 const fs::path& page_file) {
  const std::vector<OpenedRun> runs = OpenRuns(run_folders);
  PageFrame page;
  page.stored_frames = StoredFrames(LongestRun(runs), limits.most_frames, WorstFrames(runs));
  page.grid = PositionGrid::Over(BoundingBoxOf(runs, page.stored_frames));
  page.most_vertices = limits.most_vertices;
  page.error_scale_m = ErrorScaleOf(runs, page.stored_frames);
  PackedArrays arrays;
  const Json content = PageContent(runs, page, arrays);
  WriteWholeFile(page_file, Page(TitleOf(runs), content, arrays));
}

}  // namespace vitruvia
