#include "reports/pages/picture_section.h"

#include <fmt/format.h>

#include "reports/drawing/color_maps.h"
#include "reports/drawing/html_text.h"

namespace vitruvia {
namespace {

// Pictures beyond this size are only in figures/, so that the page opens on a phone.
constexpr std::size_t kStripBudget_bytes = 6'500'000;

// A strip of so many pictures leaves room to show each as large as it is.
constexpr std::size_t kFewPictures = 4;

std::string ColorBar(const std::string& label, Color (*color_of)(double),
                     const std::vector<std::string>& ticks) {
  constexpr int kStops = 12;
  std::string stops, marks;
  for (int i = 0; i <= kStops; ++i)
    stops += ", " + CssColor(color_of(static_cast<double>(i) / kStops));
  for (const std::string& tick : ticks) marks += "<b>" + Escaped(tick) + "</b>";
  return fmt::format(
      "<div class=\"bar\">{}<i style=\"background:linear-gradient(to right{})\"></i>"
      "<span>{}</span></div>",
      Escaped(label), stops, marks);
}

std::string PictureLegend(const RunPictures& run) {
  std::string html = "<div class=\"bars\">";
  if (run.farthest_m > 0.0) {
    html += ColorBar("depth (m)", DepthColor,
                     {fmt::format("{:.1f}", run.nearest_m), fmt::format("{:.1f}", run.farthest_m)});
  }
  if (run.error_scale_m > 0.0) {
    html += ColorBar("error (mm)", ErrorColor,
                     {"0", fmt::format("{:g}", 500.0 * run.error_scale_m),
                      fmt::format("≥ {:g}", 1000.0 * run.error_scale_m)});
  }
  std::string keys;
  for (const auto& [color, meaning] : run.keys) {
    keys += fmt::format("{}<span class=\"key\" style=\"background:{}\"></span>{}",
                        keys.empty() ? "" : "<br>", CssColor(color), Escaped(meaning));
  }
  return html + "<div>" + keys + "</div></div>\n";
}

std::string StripHtml(const RunPictures& run, const PictureStrip& strip) {
  std::string cells;
  for (std::size_t i = 0; i < strip.pictures.size(); ++i) {
    const std::string& title = run.titles[i];
    cells += fmt::format(
        "<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}, {} of {}\">"
        "<figcaption>{}</figcaption></figure>\n",
        DataUri(strip.pictures[i].png), kPictureSize, kPictureSize, Escaped(title),
        Escaped(strip.label), Escaped(run.run_id), Escaped(title));
  }
  const std::string sublabel = strip.sublabel.empty() ? "" : strip.sublabel + " · ";
  return fmt::format(
      "<div class=\"strip\"><h4>{} <span class=\"soft\">{}{}{}</span></h4><div "
      "class=\"cells{}\">\n{}</div></div>\n",
      Escaped(strip.label), sublabel.empty() && strip.note.empty() ? "" : "· ", Escaped(sublabel),
      Escaped(strip.note), strip.pictures.size() <= kFewPictures ? " few" : "", cells);
}

}  // namespace

std::string RunPicturesHtml(const RunPictures& run) {
  if (!run.problem.empty()) return fmt::format("<p>No pictures: {}</p>\n", Escaped(run.problem));
  std::string html = PictureLegend(run);
  for (const PictureStrip& strip : run.strips) html += StripHtml(run, strip);
  return html;
}

std::string PictureSection(const std::vector<RunPictures>& runs) {
  std::string html = "<section id=\"pictures\"><h2>Pictures</h2>\n";
  std::size_t used_bytes = 0;
  for (const RunPictures& run : runs) {
    html += fmt::format("<h3 class=\"run\">{}</h3>\n", Escaped(run.run_id));
    const std::string strips = RunPicturesHtml(run);
    if (used_bytes + strips.size() > kStripBudget_bytes) {
      html += fmt::format(
          "<p>This run’s pictures are in <code>figures/pictures-{}.png</code>; they would make the "
          "page too heavy.</p>\n",
          Escaped(run.run_id));
      continue;
    }
    used_bytes += strips.size();
    html += strips;
  }
  return html + "</section>\n";
}

}  // namespace vitruvia
