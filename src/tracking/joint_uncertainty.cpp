#include "tracking/joint_uncertainty.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace vitruvia {
namespace {

double Squared(double x) { return x * x; }

Matrix3<double> CovarianceOf(const Matrix3<double>& unit_covariance, const Vector3<double>& joint,
                             const JointSupport& support, bool has_failed,
                             const UncertaintySettings& settings) {
  const double inflation =
      settings.inflation * (1.0 + settings.unconfirmed_inflation * (1.0 - support.confirmed));
  const double noise_m2 = Squared(inflation * settings.sensor.AxialDeviation_m(joint.z()));
  const double other_m2 = Squared(settings.model_deviation_m) +
                          Squared(settings.bend_deviation_m * support.bend_rad) +
                          Squared(settings.disagreement_deviation_m * support.disagreement) +
                          (has_failed ? Squared(settings.lost_deviation_m) : 0.0);
  return noise_m2 * unit_covariance + other_m2 * Matrix3<double>::Identity();
}

double LongestAxis_m(const Matrix3<double>& covariance) {
  Eigen::SelfAdjointEigenSolver<Matrix3<double>> solver;
  solver.computeDirect(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()[2]);
}

}  // namespace

void UncertaintySettings::Describe(Fields& f) {
  f.Number("inflation", inflation,
           {.meaning = "factor on the standard deviation of joints that follows from sensor noise "
                       "alone; 0: no covariances are estimated",
            .min = 0,
            .max = 1e6,
            .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Number(
      "unconfirmed_inflation", unconfirmed_inflation,
      {.meaning = "growth of the inflation with the share of the visible vertices of a joint's "
                  "bone that the frame does not confirm: 1 doubles it where none is confirmed",
       .min = 0,
       .max = 1e6,
       .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Section("sensor", sensor, {.meaning = "noise of the sensor that covariances are computed for"});
  f.Number("model_deviation_m", model_deviation_m,
           {.meaning = "standard deviation, along each axis, of the distance between the model's "
                       "joints and the person's",
            .unit = "m",
            .min = 0,
            .max = 1,
            .origin = Origin::kGuessed,
            .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Number("bend_deviation_m", bend_deviation_m,
           {.meaning = "standard deviation, along each axis, of a joint that is bent by one radian "
                       "from the rest pose; proportional to the angle",
            .unit = "m/rad",
            .min = 0,
            .max = 1,
            .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Number("disagreement_deviation_m", disagreement_deviation_m,
           {.meaning = "standard deviation, along each axis, of a joint at whose bones the frame "
                       "and the model disagree everywhere; proportional to the share of area in "
                       "which they do",
            .unit = "m",
            .min = 0,
            .max = 10,
            .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Number(
      "lost_deviation_m", lost_deviation_m,
      {.meaning = "standard deviation, along each axis, that is added to all joints of a frame "
                  "that is reported as lost",
       .unit = "m",
       .min = 0,
       .max = 10,
       .origin = Origin::kGuessed,
       .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
  f.Number("unreliable_above_m", unreliable_above_m,
           {.meaning = "a joint is unreliable when the longest axis of its covariance, as a "
                       "standard deviation, exceeds this",
            .unit = "m",
            .min = 0,
            .max = 10,
            .origin = Origin::kGuessed,
            .source = "configs/methods/realtime_scape_uncertain.json holds what was calibrated"});
}

std::vector<Matrix3<double>> UnitCovariances(const Eigen::MatrixXd& hessian,
                                             const Eigen::MatrixXd& motions) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(hessian);
  if (cholesky.info() != Eigen::Success) return {};
  const Eigen::MatrixXd halves = cholesky.matrixL().solve(motions.transpose());
  std::vector<Matrix3<double>> covariances;
  for (Eigen::Index first = 0; first < halves.cols(); first += 3) {
    const auto half = halves.middleCols<3>(first);
    covariances.emplace_back(half.transpose() * half);
    if (!covariances.back().allFinite()) return {};
  }
  return covariances;
}

void ReportUncertainty(const std::vector<Matrix3<double>>& unit_covariances,
                       const std::vector<JointSupport>& supports,
                       const UncertaintySettings& settings, TrackResult& result) {
  result.joint_covariances.clear();
  result.unreliable_joints.assign(result.joints.size(), true);
  if (unit_covariances.empty()) return;
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const JointSupport support = supports.empty() ? JointSupport{} : supports[j];
    const Matrix3<double>& covariance = result.joint_covariances.emplace_back(CovarianceOf(
        unit_covariances[j], result.joints[j], support, IsFailure(result.outcome), settings));
    result.unreliable_joints[j] = LongestAxis_m(covariance) > settings.unreliable_above_m;
  }
}

}  // namespace vitruvia
