// The M-step of Ye & Yang 2014 as rows: each visible vertex is drawn to the mean of the points that
// it explains, Σ_m p_m ‖x̄_m − v_m(Θ)‖² / 2σ².
#pragma once

#include "articulated/data_term.h"
#include "fitting/shaped_body.h"
#include "methods/gmm_articulated/mixture.h"
#include "methods/gmm_articulated/settings.h"
#include "tracking/tracker.h"

namespace vitruvia::gmm_articulated {

class MixtureTerm final : public articulated::DataTerm {
 public:
  // The body must outlive the term.
  MixtureTerm(const ShapedBody& body, const PinholeCamera& camera, const Settings& settings);

  void Observe(const articulated::Observation& observation) override;
  // Finds the visible vertices, which are the mixture's centres until the next call, and resets σ
  // to first_sigma_m.
  void Begin(const articulated::MovingBones& bones) override;
  void AddRows(const articulated::MovingBones& bones, double progress, WorkerTeam& team,
               articulated::Clock& clock, articulated::PoseSystem& system) override;
  std::vector<NamedValue> Energies() const override;

  double sigma_m() const { return sigma_m_; }  // of the rows last added

 private:
  void PoseVertices(const BoneTransforms& camera_from_rest);
  void EstimateSigma();
  void AddVertexRows(const BoneTransforms& camera_from_rest, articulated::PoseSystem& system) const;

  const ShapedBody& body_;
  Settings settings_;
  articulated::ModelView view_;
  Mixture mixture_;
  double energy_ = 0.0;

  articulated::Observation observation_{};
  double volume_m3_ = 1.0;
  double middle_depth_m_ = 1.0;
  std::vector<int> visible_;
  double sigma_m_ = 0.0;
  bool has_expected_ = false;                        // since Begin
  std::vector<Vector3f> vertices_, before_, moves_;  // of the visible ones, camera frame
};

}  // namespace vitruvia::gmm_articulated
