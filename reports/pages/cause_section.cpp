#include "reports/pages/cause_section.h"

#include <algorithm>

#include <fmt/format.h>

#include "diagnosis/cause.h"
#include "reports/drawing/html_text.h"
#include "reports/pages/viewer_link.h"

namespace vitruvia {
namespace {

// Pictures beyond this are left out, so that the page opens on a phone; a run's viewer has them.
constexpr std::size_t kPictureBudget_bytes = 2'500'000;

bool IsExplained(const RunCauses& run) { return !run.diagnosis.events.empty(); }

// That hold some of some run's error, small errors last.
std::vector<Cause> CausesThere(const std::vector<RunCauses>& runs) {
  std::vector<Cause> causes;
  for (int i = 0; i < kCauseCount; ++i) {
    const bool is_there = std::ranges::any_of(
        runs, [i](const RunCauses& run) { return run.diagnosis.shares[i] > 0.0; });
    if (is_there) causes.push_back(static_cast<Cause>(i));
  }
  std::stable_partition(causes.begin(), causes.end(),
                        [](Cause cause) { return cause != Cause::kSmall; });
  return causes;
}

std::string ShareTable(const std::vector<RunCauses>& runs) {
  const std::vector<Cause> causes = CausesThere(runs);
  std::string head = "<th><button type=\"button\">run</button></th>", rows;
  for (const Cause cause : causes) {
    head += fmt::format("<th class=\"n\" title=\"{}\"><button type=\"button\">{}</button></th>",
                        Escaped(std::string(Meaning(cause))), Name(cause));
  }
  for (const RunCauses& run : runs) {
    if (!IsExplained(run)) continue;
    rows += fmt::format("<tr><td class=\"run\" data-value=\"{0}\">{0}</td>", Escaped(run.run_id));
    for (const Cause cause : causes) {
      const double share = run.diagnosis.shares[static_cast<std::size_t>(cause)];
      rows += fmt::format("<td class=\"n\" data-value=\"{:.6f}\">{}</td>", share,
                          share > 0.0 ? fmt::format("{:.1f} %", 1e2 * share) : "–");
    }
    rows += "</tr>\n";
  }
  return fmt::format(
      "<div class=\"scroll\"><table class=\"sortable\"><thead><tr>{}</tr></thead><tbody>\n{}"
      "</tbody></table></div>\n",
      head, rows);
}

std::string EventItem(const ErrorEvent& event, const Picture* picture, const std::string& viewer) {
  const std::string frames = event.first == event.last
                                 ? fmt::format("frame {}", event.first)
                                 : fmt::format("frames {}–{}", event.first, event.last);
  const std::string image =
      picture == nullptr
          ? "<span></span>"
          : fmt::format(
                "<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"Truth and estimate in "
                "frame {}\">",
                DataUri(picture->png), kEventPictureSize, kEventPictureSize, event.worst);
  const std::string link = viewer.empty() ? ""
                                          : fmt::format(" <a href=\"{}#frame={}\">3-D</a>",
                                                        Escaped(viewer), event.worst);
  return fmt::format("<li>{}<div><b>{}</b>{}, {:.1f} % of the error; {}{}</div></li>\n", image,
                     Name(event.cause), frames, 1e2 * event.share, Escaped(event.reason), link);
}

std::string EventList(const ReportedExperiment& experiment, const RunCauses& run,
                      std::size_t& used_bytes) {
  if (!run.problem.empty()) return fmt::format("<p>No causes: {}</p>\n", Escaped(run.problem));
  if (!IsExplained(run)) return "<p>The sequence has no true joints.</p>\n";
  std::size_t bytes = 0;
  for (const Picture& picture : run.pictures) bytes += 4 * picture.png.size() / 3;
  const bool has_room = used_bytes + bytes <= kPictureBudget_bytes;
  if (has_room) used_bytes += bytes;
  const std::string viewer = ViewerLink(experiment.folder, run.run_id, experiment.folder);
  std::string items;
  for (std::size_t i = 0; i < run.diagnosis.events.size(); ++i) {
    items += EventItem(run.diagnosis.events[i], has_room ? &run.pictures[i] : nullptr, viewer);
  }
  return fmt::format("{}<ol class=\"events\">\n{}</ol>\n",
                     has_room ? ""
                              : "<p class=\"soft\">Its viewer has the pictures; they would make "
                                "the page too heavy.</p>",
                     items);
}

}  // namespace

std::string CauseSection(const ReportedExperiment& experiment, const std::vector<RunCauses>& runs) {
  if (runs.empty()) return "";
  std::string html =
      "<section id=\"causes\"><h2>Causes of errors</h2>\n<p>How much of a run’s joint error, "
      "summed over joints and frames, arose under each circumstance; small: joints that are at "
      "most 3 cm "
      "off.</p>\n";
  if (std::ranges::any_of(runs, IsExplained)) html += ShareTable(runs);
  html += "<h3>Worst events</h3>\n";
  std::size_t used_bytes = 0;
  bool first = true;
  for (const RunCauses& run : runs) {
    html += fmt::format("<details{}><summary class=\"run\">{}</summary>{}</details>\n",
                        first ? " open" : "", Escaped(run.run_id),
                        EventList(experiment, run, used_bytes));
    first = false;
  }
  return html + "</section>\n";
}

}  // namespace vitruvia
