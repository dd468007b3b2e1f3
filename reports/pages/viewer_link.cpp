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
  return fmt::format("{0} <a href=\"{1}\" aria-label=\"{0} in three dimensions\">3-D</a>",
                     Escaped(run_id), Escaped(link));
}

}  // namespace vitruvia
