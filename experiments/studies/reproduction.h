// Carries out the experiments that the figures of a reproduction list are made from.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/figure_records.h"
#include "analysis/reproduction_list.h"

namespace vitruvia {

// The environment variable that names the user's folder of imported Stanford EVAL sequences.
inline constexpr const char* kEvalVariable = "VITRUVIA_EVAL";

// The figures with their EVAL experiments if the user has EVAL sequences.
std::vector<ReproducedFigure> WithOwnEval(std::vector<ReproducedFigure> figures);

// Time of an experiment of the figures in this call.
struct ExperimentTime {
  std::filesystem::path experiment;
  double seconds = 0.0;
};

struct CarriedOutFigures {
  std::vector<FigureRecords> figures;
  std::vector<ExperimentTime> times;  // of experiments of which some run was carried out
};

// Carries out what is not yet done, up to `jobs` runs at a time, below `root` (an experiment's
// folder there is named after its file), and reads the records of all the figures' runs. An
// experiment that cannot be planned, for data that the user does not have, is a problem of its
// figures; a run that fails is recorded as failed. Throws Error(kInterrupted) when the user asks to
// stop; the next call goes on.
CarriedOutFigures CarryOutFigures(const ReproductionList& list,
                                  const std::vector<ReproducedFigure>& figures,
                                  const std::filesystem::path& root, int jobs);

}  // namespace vitruvia
