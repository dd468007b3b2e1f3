#include "records/frame_summary.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "metrics/catalogue.h"

namespace vitruvia {

void FrameSummary::Describe(Fields& f) {
  f.Text("name", name,
         {.meaning = "name of the summary: letters, digits, _ and -; its metric is summary[NAME]",
          .required = true});
  f.Text("series", series,
         {.meaning = "series over the frames that is summarised, as record.json has it under "
                     "frames (vitruvia explain)",
          .required = true});
  f.Texts("joints", joints,
          {.meaning = "joints that joint_error_mean_m or joint_error_max_m is taken over in each "
                      "frame; all if empty",
           .optional = true});
  f.Choice("statistic", statistic,
           {{"mean", FrameStatistic::kMean},
            {"median", FrameStatistic::kMedian},
            {"quantile", FrameStatistic::kQuantile},
            {"minimum", FrameStatistic::kMinimum},
            {"maximum", FrameStatistic::kMaximum},
            {"share_above", FrameStatistic::kShareAbove},
            {"share_below", FrameStatistic::kShareBelow}},
           {.meaning = "what is taken over the frames that have a value; shares are of these "
                       "frames"});
  f.Number("quantile", quantile,
           {.meaning = "share of the frames below the value, of the statistic quantile",
            .min = 0.0,
            .max = 1.0});
  f.Number("level", level,
           {.meaning = "value that shares are above or below, in the unit of the stored series"});
}

std::string FrameSummary::Problem() const {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain) return fmt::format("name \"{}\": expected letters, digits, _ and - only", name);
  if (std::string problem = UnknownMetricProblem(series); !problem.empty())
    return "series: " + problem;
  if (!joints.empty() && series != "joint_error_mean_m" && series != "joint_error_max_m")
    return fmt::format(
        "joints: only joint_error_mean_m and joint_error_max_m are taken over joints, got the "
        "series {}",
        series);
  return "";
}

}  // namespace vitruvia
