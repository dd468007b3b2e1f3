// The list of the papers' reproduced figures and tables: the content of each, the experiments that
// it is made from, and the tests of the claim that it supports.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/claims.h"
#include "config/settings.h"

namespace vitruvia {

// A reduction of an experiment that suffices for its figures.
struct ExperimentReduction {
  std::filesystem::path experiment;
  std::string only;        // pattern of run ids, variants or scenes; "": all runs
  int most_frames = 0;     // of each scene; 0: all
  std::vector<int> seeds;  // replace those of the experiment; empty: unchanged
  std::string why;

  void Describe(Fields& fields);
};

// Pictures of some runs.
struct ShownPictures {
  std::string of = "*";             // pattern of "method/variant"
  std::vector<std::string> scenes;  // patterns; empty: all
  std::vector<int> seeds;           // empty: all
  std::vector<int> frames;          // empty: those of the experiment
  std::vector<std::string> panels;  // patterns of the pictures' titles; empty: all
  bool side_by_side = false;        // runs of a sequence below each other

  void Describe(Fields& fields);
};

// What a row of a table stands for.
enum class TableRows {
  kContenders,  // "method/variant"
  kMethods,     // each over all of its variants
};

// Means over runs.
struct ShownTable {
  std::string title;
  TableRows rows = TableRows::kContenders;
  std::vector<std::string> scenes{};  // patterns; empty: all
  std::vector<std::string> metrics{};

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct ReproducedFigure {
  std::string id;     // "A11": how a command names it
  std::string place;  // "Paper A, figure 11"
  std::string title, caption;
  std::string published, claim;  // "": not related to a claim of a paper
  std::vector<std::filesystem::path> experiments;
  // Used instead of `experiments` if the user has Stanford EVAL; empty: no replacement.
  std::vector<std::filesystem::path> eval_experiments;
  std::vector<ClaimTest> tests;
  std::string cannot_be_tested;  // reason if no test can decide the claim
  std::vector<ShownPictures> pictures;
  std::vector<std::string> plots;  // names of plots (reports/figures), or their beginnings
  std::vector<ShownTable> tables;

  void Describe(Fields& fields);
  std::string Problem() const;
};

struct ReproductionList {
  std::string title, description;
  std::vector<ExperimentReduction> reductions;
  std::vector<ReproducedFigure> figures;  // in the order of the page

  void Describe(Fields& fields);
  std::string Problem() const;

  // The experiment's reduction; nullptr if it is run completely.
  const ExperimentReduction* ReductionOf(const std::filesystem::path& experiment) const;
};

// The figures of those ids, in the list's order; all if there are no ids. ConfigError naming the
// nearest id if an id does not exist.
std::vector<ReproducedFigure> ChosenFigures(const ReproductionList& list,
                                            const std::vector<std::string>& ids);

}  // namespace vitruvia
