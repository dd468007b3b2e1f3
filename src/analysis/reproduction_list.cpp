#include "analysis/reproduction_list.h"

#include <algorithm>
#include <set>

#include "config/did_you_mean.h"
#include "core/error.h"
#include "metrics/catalogue.h"

namespace vitruvia {

void ExperimentReduction::Describe(Fields& f) {
  f.File("experiment", experiment, {.meaning = "experiment file", .required = true});
  f.Text("only", only,
         {.meaning = "pattern (* ? [abc]) of the run ids, variants or scenes that are carried out; "
                     "all if empty"});
  f.Integer("most_frames", most_frames,
            {.meaning = "number of frames of each scene at most; 0 is all",
             .unit = "frames",
             .min = 0,
             .max = 1e6});
  f.Integers(
      "seeds", seeds,
      {.meaning = "seeds that replace those of the experiment; if empty, the experiment's are used",
       .min = 0,
       .max = 1e9});
  f.Text("why", why, {.meaning = "reason why a part of the experiment suffices", .required = true});
}

void ShownPictures::Describe(Fields& f) {
  f.Text("of", of, {.meaning = "contenders whose runs are shown: pattern of \"method/variant\""});
  f.Texts("scenes", scenes, {.meaning = "patterns of the scenes that are shown; all if empty"});
  f.Integers("seeds", seeds, {.meaning = "seeds that are shown; all if empty", .min = 0});
  f.Integers("frames", frames,
             {.meaning = "frames that are shown; those of the experiment if empty", .min = 0});
  f.Texts("panels", panels,
          {.meaning = "patterns of the titles of the pictures that are shown; all if empty"});
  f.Flag(
      "side_by_side", side_by_side,
      {.meaning = "true: all runs of a sequence below each other, front and back in two colours; "
                  "false: each run by itself, with the depth and the error"});
}

void ShownTable::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "title of the table", .required = true});
  f.Choice("rows", rows, {{"contenders", TableRows::kContenders}, {"methods", TableRows::kMethods}},
           {.meaning = "rows of the table: methods with each of their variants, or methods over "
                       "all of their variants"});
  f.Texts("scenes", scenes,
          {.meaning = "patterns of the scenes that the table averages over; all if empty"});
  f.Texts("metrics", metrics,
          {.meaning = "keys of the metrics in the table's columns", .required = true});
}

std::string ShownTable::Problem() const {
  if (metrics.empty()) return "metrics: expected at least one key, got none";
  for (const std::string& key : metrics) {
    if (std::string problem = UnknownMetricProblem(key); !problem.empty()) return problem;
  }
  return "";
}

void ReproducedFigure::Describe(Fields& f) {
  f.Text("id", id, {.meaning = "name of the figure on the command line", .required = true});
  f.Text("place", place, {.meaning = "place of the figure in the papers", .required = true});
  f.Text("title", title, {.meaning = "title of the figure", .required = true});
  f.Text("caption", caption, {.meaning = "what the reproduced figure shows", .required = true});
  f.Text("published", published, {.meaning = "what the paper shows or prints there"});
  f.Text("claim", claim,
         {.meaning = "the paper's claim that the figure supports; empty if it supports none"});
  f.Files("experiments", experiments,
          {.meaning = "experiment files from which the figure is made", .required = true});
  f.Files("eval_experiments", eval_experiments,
          {.meaning = "experiment files that replace `experiments` if VITRUVIA_EVAL names a folder "
                      "of imported Stanford EVAL sequences"});
  f.List("tests", tests, {.meaning = "tests of the claim; the claim holds if all of them hold"});
  f.Text("cannot_be_tested", cannot_be_tested,
         {.meaning = "reason why the claim cannot be tested; there are no tests then"});
  f.List("pictures", pictures, {.meaning = "pictures that are shown"});
  f.Texts("plots", plots, {.meaning = "names of plots that are shown, or their beginnings"});
  f.List("tables", tables, {.meaning = "tables that are shown"});
}

std::string ReproducedFigure::Problem() const {
  if (experiments.empty()) return "experiments: expected at least one experiment file, got none";
  const bool decides = !tests.empty() || !cannot_be_tested.empty();
  if (claim.empty() && decides)
    return fmt::format("{}: without a claim expected neither tests nor cannot_be_tested", id);
  if (!claim.empty() && tests.empty() == cannot_be_tested.empty())
    return fmt::format("{}: expected either tests or cannot_be_tested", id);
  return "";
}

void ReproductionList::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "title of the page", .required = true});
  f.Text("description", description, {.meaning = "what is printed at the head of the page"});
  f.List("reductions", reductions,
         {.meaning = "experiments of which only a part is run for the page"});
  f.List("figures", figures, {.meaning = "figures in the order of the page", .required = true});
}

std::string ReproductionList::Problem() const {
  std::set<std::string> ids;
  for (const ReproducedFigure& figure : figures) {
    if (!ids.insert(figure.id).second)
      return fmt::format("figures: the id \"{}\" stands twice", figure.id);
  }
  for (const ExperimentReduction& reduction : reductions) {
    const bool is_used =
        std::any_of(figures.begin(), figures.end(), [&reduction](const ReproducedFigure& figure) {
          const auto& files = figure.experiments;
          return std::find(files.begin(), files.end(), reduction.experiment) != files.end();
        });
    if (!is_used)
      return fmt::format("reductions: no figure is made from {}", reduction.experiment.string());
  }
  return "";
}

const ExperimentReduction* ReproductionList::ReductionOf(
    const std::filesystem::path& experiment) const {
  const auto found =
      std::find_if(reductions.begin(), reductions.end(),
                   [&](const ExperimentReduction& r) { return r.experiment == experiment; });
  return found == reductions.end() ? nullptr : &*found;
}

std::vector<ReproducedFigure> ChosenFigures(const ReproductionList& list,
                                            const std::vector<std::string>& ids) {
  std::vector<std::string> known;
  for (const ReproducedFigure& figure : list.figures) known.push_back(figure.id);
  for (const std::string& id : ids) {
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    throw ConfigError(fmt::format("no figure \"{}\";{} there are: {}", id,
                                  DidYouMean(id, known, " "), fmt::join(known, ", ")));
  }
  std::vector<ReproducedFigure> chosen;
  for (const ReproducedFigure& figure : list.figures) {
    if (ids.empty() || std::find(ids.begin(), ids.end(), figure.id) != ids.end())
      chosen.push_back(figure);
  }
  return chosen;
}

}  // namespace vitruvia
