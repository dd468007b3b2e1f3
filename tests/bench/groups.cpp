#include <array>

#include "bench/bench.h"

namespace vitruvia::bench {

std::vector<Row> Baselines();
std::vector<Row> BaselineModels();
std::vector<Row> FitShape();
std::vector<Row> Frames();
std::vector<Row> Growth();
std::vector<Row> ImportDepth();
std::vector<Row> LearnWeights();
std::vector<Row> Scan();
std::vector<Row> Starts();

std::span<const Group> Groups() {
  static constexpr std::array kGroups = {
      Group{"baselines", Baselines},
      Group{"baseline_models", BaselineModels},
      Group{"fit_shape", FitShape},
      Group{"frames", Frames},
      Group{"growth", Growth},
      Group{"import_depth", ImportDepth},
      Group{"learn_weights", LearnWeights},
      Group{"scan", Scan},
      Group{"starts", Starts},
  };
  return kGroups;
}

}  // namespace vitruvia::bench
