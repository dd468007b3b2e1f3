#include "learning/joints/joint_model.h"

#include "core/error.h"

namespace vitruvia::joints {
namespace {

// The zero vector, then the same places for every detector.
std::vector<Vector3f> VotePlaces(int votes) {
  RandomStream random(1, "votes");
  std::vector<Vector3f> places{Vector3f::Zero()};
  while (static_cast<int>(places.size()) < votes) {
    Vector3f place;
    for (float& x : place) x = static_cast<float>(random.Normal());
    places.push_back(place);
  }
  return places;
}

template <class View>
Vector3f MeanOffset(const Forest& forest, const View& view, const FeaturePoint& point) {
  Vector3f sum = Vector3f::Zero();
  for (const RegressionTree& tree : forest) sum += tree.Offset(view, point);
  return sum / static_cast<float>(forest.size());
}

}  // namespace

void VoteSettings::Describe(Fields& f) {
  f.Integer("places", places,
            {.meaning = "number of places that vote on each step to a joint: where the last step "
                        "ended, and others round it",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed,
             .source = "the random tree walk averages its steps"});
  f.Number(
      "spread", spread,
      {.meaning = "standard deviation of the places that vote on a step to a joint, as a share "
                  "of the jitter that its stage has learnt with",
       .min = 0.0,
       .max = 10.0,
       .origin = Origin::kGuessed});
}

JointDetector::JointDetector(const JointModel& model, const VoteSettings& votes)
    : model_(model), spread_(votes.spread), places_(VotePlaces(votes.places)) {}

std::optional<BodyPointPositions> JointDetector::Detect(const DepthImage& depth,
                                                        const PinholeCamera& camera,
                                                        double max_depth_m) const {
  const std::optional<Vector3d> centroid = MeasuredCentroid(depth, camera, max_depth_m);
  if (!centroid) return {};
  const WholeDepth view{depth, static_cast<float>(max_depth_m)};
  BodyPointPositions found;
  for (int p = 0; p < kBodyPointCount; ++p) {
    const int parent = BodyPoints()[p].parent;
    Vector3f place = (parent < 0 ? *centroid : found[parent]).cast<float>();
    for (const JointStage& stage : model_.stages) {
      const auto spread_m = static_cast<float>(spread_ * stage.jitter_m);
      Vector3f sum = Vector3f::Zero();
      for (const Vector3f& vote : places_) {
        const Vector3f at = place + spread_m * vote;
        sum += at + MeanOffset(stage.forests[p], view, FeaturePoint(camera, at));
      }
      place = sum / static_cast<float>(places_.size());
    }
    found[p] = place.cast<double>();
  }
  return found;
}

std::optional<Vector3d> MeasuredCentroid(const DepthImage& depth, const PinholeCamera& camera,
                                         double max_depth_m) {
  const WholeDepth view{depth, static_cast<float>(max_depth_m)};
  Vector3d sum = Vector3d::Zero();
  std::size_t count = 0;
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const double z = view.At(u, v);
      if (z == 0.0) continue;
      sum += camera.Unproject<double>(u, v, z);
      ++count;
    }
  }
  if (count == 0) return {};
  return sum / static_cast<double>(count);
}

}  // namespace vitruvia::joints
