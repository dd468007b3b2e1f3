#include "reports/pages/viewer_link.h"

#include <fmt/format.h>

#include "reports/drawing/html_text.h"
#include "reports/viewer/viewer.h"

namespace vitruvia {
namespace fs = std::filesystem;

std::string ViewerLink(const fs::path& experiment_folder, const std::string& run_id,
                       const fs::path& from) {
  const fs::path page = experiment_folder / run_id / kViewerPage;
  return fs::exists(page) ? page.lexically_relative(from).generic_string() : "";
}

std::string RunWithViewer(const std::string& run_id, const std::string& link) {
  if (link.empty()) return Escaped(run_id);
  return fmt::format(
      "{0} <a href=\"{1}\" aria-label=\"{0} in three dimensions\">3-D</a> <input type=\"checkbox\" "
      "value=\"{1}\" aria-label=\"choose {0}\">",
      Escaped(run_id), Escaped(link));
}

std::string ViewerChoice(bool any_viewer, const std::string& experiment_folder) {
  if (any_viewer) {
    return "<p class=\"choose\"><button type=\"button\">Open chosen runs in "
           "lockstep</button></p>\n";
  }
  return fmt::format(
      "<p class=\"soft\"><code>vitruvia view {}</code> writes a page for each run in which it is "
      "seen in three dimensions, and links it here.</p>\n",
      Escaped(experiment_folder));
}

}  // namespace vitruvia
