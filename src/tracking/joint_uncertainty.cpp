#include "tracking/joint_uncertainty.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace vitruvia {
namespace {

Matrix3<double> CovarianceOf(const Matrix3<double>& unit_covariance, const Vector3<double>& joint,
                             const UncertaintySettings& settings) {
  const double deviation_m = settings.inflation * settings.sensor.AxialDeviation_m(joint.z());
  const double model_m2 = settings.model_deviation_m * settings.model_deviation_m;
  return deviation_m * deviation_m * unit_covariance + model_m2 * Matrix3<double>::Identity();
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
  f.Section("sensor", sensor, {.meaning = "noise of the sensor that covariances are computed for"});
  f.Number("model_deviation_m", model_deviation_m,
           {.meaning = "standard deviation, along each axis, of the distance between the model's "
                       "joints and the person's",
            .unit = "m",
            .min = 0,
            .max = 1,
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
                       const UncertaintySettings& settings, TrackResult& result) {
  result.joint_covariances.clear();
  result.unreliable_joints.assign(result.joints.size(), true);
  if (unit_covariances.empty()) return;
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    result.joint_covariances.push_back(
        CovarianceOf(unit_covariances[j], result.joints[j], settings));
    if (IsFailure(result.outcome)) continue;
    result.unreliable_joints[j] =
        LongestAxis_m(result.joint_covariances[j]) > settings.unreliable_above_m;
  }
}

}  // namespace vitruvia
