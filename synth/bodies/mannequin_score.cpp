#include "synth/bodies/mannequin_score.h"

#include <cmath>

namespace vitruvia::mannequin {
namespace {

class ScoreSearch {
 public:
  ScoreSearch(const std::function<double(double)>& volume_at, double volume_m3)
      : volume_at_(volume_at), volume_m3_(volume_m3) {}

  double Find() {
    double low = kLeastScore, high = kGreatestScore, score = 0.0;
    for (int step = 0; step < kScoreSteps; ++step) {
      score = 0.5 * (low + high);
      if (!enclosed_ && below_ > kLeastScore && above_ < kGreatestScore) Enclose();
      if (score > below_ && score < above_) Try(score);
      (score <= below_ ? low : high) = score;
    }
    return score;
  }

 private:
  struct Trial {
    double score = 0.0, volume_m3 = 0.0;
  };

  void Try(double score) {
    before_ = last_;
    last_ = {score, volume_at_(score)};
    double& side = last_.volume_m3 < volume_m3_ ? below_ : above_;
    side = score;
  }

  void Enclose() {
    constexpr int kMostTrials = 8;
    constexpr double kConverged = 1e-5;  // the next secant's error is about its square
    constexpr double kBeside = 2e-8;     // far below the width of the last step
    enclosed_ = true;
    double guess = last_.score;
    for (int trial = 0; trial < kMostTrials; ++trial) {
      const double secant = last_.score + (volume_m3_ - last_.volume_m3) *
                                              (last_.score - before_.score) /
                                              (last_.volume_m3 - before_.volume_m3);
      if (!(secant > below_ && secant < above_)) return;
      const bool converged = std::abs(secant - guess) < kConverged;
      guess = secant;
      if (converged) break;
      Try(guess);
    }
    for (const double beside : {guess - kBeside, guess + kBeside}) {
      if (beside > below_ && beside < above_) Try(beside);
    }
  }

  const std::function<double(double)>& volume_at_;
  double volume_m3_;
  double below_ = kLeastScore,
         above_ = kGreatestScore;  // the nearest scores of too small and other volumes
  Trial before_, last_;
  bool enclosed_ = false;
};

}  // namespace

double ScoreOfVolume(const std::function<double(double)>& volume_at, double volume_m3) {
  return ScoreSearch(volume_at, volume_m3).Find();
}

}  // namespace vitruvia::mannequin
