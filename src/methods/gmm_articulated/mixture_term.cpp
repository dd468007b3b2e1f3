#include "methods/gmm_articulated/mixture_term.h"

#include <algorithm>
#include <cmath>

#include "math/rigid.h"

namespace vitruvia::gmm_articulated {

using articulated::CarriedPoint;
using articulated::Clock;
using articulated::MovingBones;
using articulated::PoseSystem;
using articulated::TimedStep;

MixtureTerm::MixtureTerm(const ShapedBody& body, const PinholeCamera& camera,
                         const Settings& settings)
    : body_(body), settings_(settings), view_(body, camera) {}

// Outliers are uniformly distributed in the points' bounding box with a margin.
void MixtureTerm::Observe(const articulated::Observation& observation) {
  constexpr float kMargin_m = 0.1f;
  observation_ = observation;
  const Eigen::AlignedBox3f box = BoundingBox(observation.cloud->points);
  volume_m3_ = double{(box.sizes() + Vector3f::Constant(2.0f * kMargin_m)).prod()};
  middle_depth_m_ = double{box.center().z()};
}

void MixtureTerm::Begin(const MovingBones& bones) {
  view_.Look(bones.camera_from_rest());
  visible_ = view_.visible();
  sigma_m_ = settings_.first_sigma_m;
  has_expected_ = false;
}

void MixtureTerm::PoseVertices(const BoneTransforms& camera_from_rest) {
  std::array<Rigidf, kBoneCount> bones;
  for (int b = 0; b < kBoneCount; ++b) bones[b] = camera_from_rest[b].Cast<float>();
  vertices_.resize(visible_.size());
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const auto v = static_cast<std::size_t>(visible_[i]);
    Vector3f sum = Vector3f::Zero();
    for (int k = 0; k < kMaxInfluences && body_.weights.weights[v][k] > 0.0f; ++k) {
      sum += body_.weights.weights[v][k] * (bones[body_.weights.bones[v][k]] * body_.mean[v]);
    }
    vertices_[i] = sum;
  }
}

// Estimates σ from the shares of the last iteration and the vertices' motion since.
void MixtureTerm::EstimateSigma() {
  if (!has_expected_ || !(mixture_.mass() > 0.0)) return;
  moves_.resize(vertices_.size());
  for (std::size_t i = 0; i < moves_.size(); ++i) moves_[i] = vertices_[i] - before_[i];
  const double least_m = 0.5 * settings_.common.data.Deviation_m(middle_depth_m_);
  sigma_m_ = std::clamp(std::sqrt(mixture_.Variance(moves_)), least_m,
                        std::max(least_m, settings_.first_sigma_m));
}

void MixtureTerm::AddRows(const MovingBones& bones, double /*progress*/, WorkerTeam& team,
                          Clock& clock, PoseSystem& system) {
  PoseVertices(bones.camera_from_rest());
  clock.Lap(TimedStep::kPose);
  EstimateSigma();
  mixture_.Expect(observation_.cloud->points, vertices_, sigma_m_,
                  {settings_.outlier_share, volume_m3_, settings_.reach_sigmas}, team);
  before_ = vertices_;
  has_expected_ = true;
  clock.Lap(TimedStep::kMatch);
  AddVertexRows(bones.camera_from_rest(), system);
  energy_ = system.energy();
}

void MixtureTerm::AddVertexRows(const BoneTransforms& camera_from_rest, PoseSystem& system) const {
  constexpr float kLeastMass = 1e-3f;
  const double per_point =
      settings_.common.data.independent_points /
      (static_cast<double>(observation_.cloud->points.size()) * sigma_m_ * sigma_m_);
  std::array<CarriedPoint, kMaxInfluences> carried;
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const VertexShare& share = mixture_.shares()[i];
    if (share.mass < kLeastMass) continue;
    const auto v = static_cast<std::size_t>(visible_[i]);
    std::size_t count = 0;
    for (int k = 0; k < kMaxInfluences && body_.weights.weights[v][k] > 0.0f; ++k) {
      const int bone = body_.weights.bones[v][k];
      carried[count++] = {bone, double{body_.weights.weights[v][k]},
                          camera_from_rest[bone] * body_.mean[v].cast<double>()};
    }
    const double weight = per_point * double{share.mass};
    for (int k = 0; k < 3; ++k) {
      system.AddBlendedRow({carried.data(), count}, Vector3d::Unit(k), -double{share.offset[k]},
                           weight);
    }
  }
}

std::vector<NamedValue> MixtureTerm::Energies() const { return {{"mixture", energy_}}; }

}  // namespace vitruvia::gmm_articulated
