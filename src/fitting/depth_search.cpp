#include "fitting/depth_search.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "body/pose_statistics.h"
#include "core/error.h"
#include "fitting/pose_variation.h"
#include "math/rotation.h"

namespace vitruvia {
namespace {

constexpr double kFar_m = 0.15;  // of a cell (DepthTarget::ImageDistance)
// Poses that are kept at each step, tuned on one half of the starts of the benchmark.
constexpr int kCompared = 48, kOfTrunks = 24, kOfArms = 14, kOfFits = 7, kOfFine = 4, kLast = 3;

struct Candidate {
  FoundPose pose;
  double image_distance_m = 0.0;
};

double ByImage(const Candidate& c) { return c.image_distance_m; }
double ByDistance(const Candidate& c) { return c.pose.distance.mean_m(); }

// The best ones, without those near a better one.
void Keep(std::vector<Candidate>& candidates, int most, double (*cost)(const Candidate&),
          const ShapedBody& body) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const Candidate& a, const Candidate& b) { return cost(a) < cost(b); });
  std::vector<Candidate> kept;
  for (Candidate& candidate : candidates) {
    if (static_cast<int>(kept.size()) == most) break;
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return MeanJointDistance(body, candidate.pose.state, other.pose.state) < kSamePose_m;
    });
    if (is_new) kept.push_back(std::move(candidate));
  }
  candidates = std::move(kept);
}

// Squared Mahalanobis distance of the arms' pose from captured motion.
double UnusualnessOfArms(const AngleVector& angles_deg) {
  JointPose joints;
  joints.local_rotations.fill(Matrix3<double>::Identity());
  SetRotations(PoseOf(angles_deg), joints);
  double sum = 0.0;
  for (const BoneId bone : {BoneId::kLeftUpperArm, BoneId::kLeftForearm, BoneId::kRightUpperArm,
                            BoneId::kRightForearm}) {
    const auto b = static_cast<std::size_t>(bone);
    const LocalRotationStatistics& usual = CapturedPoseStatistics()[b];
    const Vector3d deviation = LogSo3<double>(usual.mean.transpose() * joints.local_rotations[b]);
    sum += deviation.cwiseQuotient(usual.deviation_rad).squaredNorm();
  }
  return sum;
}

class Searcher {
 public:
  Searcher(const DepthSearch& search, FitPriors priors, const NearFar& limits)
      : search_(search),
        priors_(std::move(priors)),
        limits_(limits),
        variation_(*search.coarse, *search.fine_target, kFar_m) {}

  SearchOutcome Run(const std::vector<PoseHypothesis>& hypotheses) {
    std::vector<Candidate> candidates = Compared(hypotheses);
    FitCoarsely(candidates);
    FitFinely(candidates);
    SearchOutcome outcome{candidates.front().pose, std::numeric_limits<double>::infinity()};
    if (candidates.size() > 1) {
      outcome.margin = ByDistance(candidates[1]) / ByDistance(candidates[0]) - 1.0;
    }
    outcome.best = WithLikelyArms(outcome.best);
    return outcome;
  }

 private:
  const ShapedBody& coarse_body() const { return search_.coarse->body(); }

  // By rendering alone, before anything is fitted.
  std::vector<Candidate> Compared(const std::vector<PoseHypothesis>& hypotheses) {
    std::vector<Candidate> candidates;
    for (const PoseHypothesis& h : hypotheses) {
      const JudgedPose judged =
          variation_.Judged(search_.coarse->Centered(*search_.coarse_target, h.state));
      candidates.push_back({{&h, judged.state, {}}, judged.image_distance_m});
    }
    const auto vary = [&](Candidate& c, auto change) {
      const JudgedPose varied = change(JudgedPose{c.pose.state, c.image_distance_m});
      c.pose.state = varied.state;
      c.image_distance_m = varied.image_distance_m;
    };
    Keep(candidates, kCompared, ByImage, coarse_body());
    for (Candidate& c : candidates) {
      vary(c, [&](const JudgedPose& p) { return variation_.WithLegs(variation_.WithTrunk(p)); });
    }
    Keep(candidates, kOfTrunks, ByImage, coarse_body());
    for (Candidate& c : candidates) {
      vary(c, [&](const JudgedPose& p) { return variation_.WithArms(p); });
    }
    Keep(candidates, kOfArms, ByImage, coarse_body());
    return candidates;
  }

  void FitCoarsely(std::vector<Candidate>& candidates) {
    for (Candidate& c : candidates) {
      Fit(c.pose, *search_.coarse, *search_.coarse_target, {5, 0.4, 0.15, 0.5, false});
      c.pose.state = variation_.Varied(c.pose.state).state;
      Fit(c.pose, *search_.coarse, *search_.coarse_target,
          {6, 0.3, 0.12, 0.3, search_.moves_shape});
      c.pose.distance = search_.coarse->Measure(*search_.coarse_target, c.pose.state, limits_);
    }
    Keep(candidates, kOfFits, ByDistance, coarse_body());
  }

  void FitFinely(std::vector<Candidate>& candidates) {
    const FitStage stage{8, 0.2, 0.08, 0.1, search_.moves_shape};
    for (Candidate& c : candidates) FitFine(c.pose, stage);
    Keep(candidates, kOfFine, ByDistance, coarse_body());
    std::vector<Candidate> varied = candidates;
    for (Candidate& c : varied) {
      const JudgedPose before = variation_.Judged(c.pose.state);
      const JudgedPose after = variation_.Varied(c.pose.state);
      c.pose.state = after.state;
      if (after.image_distance_m < before.image_distance_m) {
        Fit(c.pose, *search_.fine, *search_.fine_target, {4, 0.3, 0.15, 0.3, false});
      }
      FitFine(c.pose, stage);
    }
    candidates.insert(candidates.end(), varied.begin(), varied.end());
    Keep(candidates, kLast, ByDistance, coarse_body());
    for (Candidate& c : candidates) {
      FitFine(c.pose, {8, 0.12, 0.05, 0.0, search_.moves_shape});
    }
    Keep(candidates, kLast, ByDistance, coarse_body());
  }

  void Fit(FoundPose& pose, PoseFit& fit, FitTarget& target, const FitStage& stage) {
    priors_.angles_deg = pose.state.angles_deg;
    priors_.theta = pose.start->state.theta;
    pose.state = fit.Run(target, pose.state, stage, priors_);
  }

  void FitFine(FoundPose& pose, const FitStage& stage) {
    Fit(pose, *search_.fine, *search_.fine_target, stage);
    pose.distance = search_.fine->Measure(*search_.fine_target, pose.state, limits_);
  }

  // The most likely of the arms' poses that explain the frame about as well as the one found: both
  // arms alike; otherwise the more usual one of the found pose and a hanging arm.
  FoundPose WithLikelyArms(const FoundPose& found) {
    constexpr double kAsWell = 1.05;  // share of the distance
    const double most_m = kAsWell * found.distance.mean_m();
    const auto with = [&](Side side, const SideAngles& angles) {
      FoundPose pose = found;
      pose.state = WithLimb(found.state, side, angles, kShoulderFlexion, kHipFlexion);
      FitFine(pose, {3, 0.1, 0.05, 0.0, false});
      return pose;
    };
    const auto most_usual = [&](const std::vector<FoundPose>& poses) {
      const FoundPose* best = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (const FoundPose& pose : poses) {
        const double unusual = UnusualnessOfArms(pose.state.angles_deg);
        if (pose.distance.mean_m() > most_m || unusual >= least) continue;
        best = &pose;
        least = unusual;
      }
      return best ? std::optional<FoundPose>(*best) : std::nullopt;
    };
    const AnatomicalPose pose = PoseOf(found.state.angles_deg);
    SideAngles hanging{};
    hanging[kShoulderAbduction] = 8.0;
    hanging[kElbowFlexion] = 15.0;
    if (const auto alike = most_usual(
            {with(kLeft, pose.sides_deg[kRight]), with(kRight, pose.sides_deg[kLeft])})) {
      return *alike;
    }
    return most_usual({found, with(kLeft, hanging), with(kRight, hanging)}).value_or(found);
  }

  DepthSearch search_;
  FitPriors priors_;
  NearFar limits_;
  PoseVariation variation_;
};

}  // namespace

SearchOutcome SearchDepth(const std::vector<PoseHypothesis>& hypotheses, const DepthSearch& search,
                          FitPriors priors, const NearFar& limits) {
  Require(!hypotheses.empty(), "SearchDepth: no hypotheses");
  return Searcher(search, std::move(priors), limits).Run(hypotheses);
}

}  // namespace vitruvia
