#include "methods/scape_regression/frame_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "body/pose_statistics.h"
#include "math/rotation_derivatives.h"

namespace vitruvia::scape_regression {
namespace {

constexpr double kMm2PerM2 = 1e6;
constexpr double kChangeUnit_rad = 0.1;
constexpr double kFirstDamping = 1e-4, kLeastDamping = 1e-9, kDampingFactor = 10.0;
constexpr int kTries = 5;

// Geman–McClure: ρ = r² s² / (r² + s²), and the weight of r² in iteratively reweighted squares.
double Robust(double r, double s) { return r * r * s * s / (r * r + s * s); }
double RobustWeight(double r, double s) {
  const double share = s * s / (r * r + s * s);
  return share * share;
}

double PerPair(double weight, std::size_t pairs) {
  return pairs == 0 ? 0.0 : kMm2PerM2 * weight / static_cast<double>(pairs);
}

// Rows are collected and added a block at a time.
class RowSum {
 public:
  explicit RowSum(NormalEquations& equations) : equations_(equations) {}
  ~RowSum() { Flush(); }

  void Add(double weight, double residual, const ScapeBody::Row& row) {
    const double root = std::sqrt(weight);
    rows_.row(count_) = root * row;
    residuals_[count_] = root * residual;
    if (++count_ == kBlock) Flush();
  }

 private:
  static constexpr int kBlock = 128;

  void Flush() {
    const auto rows = rows_.topRows(count_);
    equations_.hessian.noalias() += rows.transpose() * rows;
    equations_.gradient.noalias() += rows.transpose() * residuals_.head(count_);
    count_ = 0;
  }

  NormalEquations& equations_;
  Eigen::Matrix<double, kBlock, ScapeBody::kParameters, Eigen::RowMajor> rows_;
  Eigen::Matrix<double, kBlock, 1> residuals_;
  int count_ = 0;
};

// Three rows of a joint's rotation; its bone and the parent enter with opposite signs.
void AddTurn(int bone, double weight, const Vector3d& residual, const Matrix3<double>& by_own,
             RowSum& sum) {
  for (int k = 0; k < 3; ++k) {
    ScapeBody::Row row = ScapeBody::Row::Zero();
    row.segment<3>(3 + 3 * bone) = by_own.row(k);
    row.segment<3>(3 + 3 * Bones()[bone].parent) = -by_own.row(k);
    sum.Add(weight, residual[k], row);
  }
}

// Δr of the pose less that of the last one, in units.
std::array<Vector3d, kBoneCount> PoseChange(const ScapePose& pose, const ScapePose& last) {
  const auto now = JointRotationVectors(pose.rotations),
             before = JointRotationVectors(last.rotations);
  std::array<Vector3d, kBoneCount> change;
  for (int b = 0; b < kBoneCount; ++b) change[b] = (now[b] - before[b]) / kChangeUnit_rad;
  return change;
}

// Each joint's turn away from its mean in captured motion, in the mean's axes.
std::array<Vector3d, kBoneCount> Unusualness(const ScapePose& pose) {
  std::array<Vector3d, kBoneCount> turns;
  turns[0].setZero();
  for (int b = 1; b < kBoneCount; ++b) {
    const Matrix3<double> local = pose.rotations[Bones()[b].parent].transpose() * pose.rotations[b];
    turns[b] = LogSo3<double>(CapturedPoseStatistics()[b].mean.transpose() * local);
  }
  return turns;
}

Vector3d PerDeviation(int bone) {
  return CapturedPoseStatistics()[bone].deviation_rad.cwiseInverse();
}

}  // namespace

const char* Name(TimedStep step) {
  switch (step) {
    case TimedStep::kRender:
      return "render and pair";
    case TimedStep::kAssemble:
      return "assemble";
    case TimedStep::kSolve:
      return "solve";
    case TimedStep::kSurface:
      return "surface";
    case TimedStep::kCount:
      break;
  }
  return "";
}

Energies FrameEnergy::Of(const Pairs& pairs, const std::vector<Vector3f>& vertices,
                         const ScapePose& pose, const ScapePose& last, double kernel_m) const {
  Energies energies;
  for (const DepthPair& pair : pairs.depth)
    energies.depth += Robust(Residual(pair, vertices[pair.vertex].cast<double>()), kernel_m);
  energies.depth *= PerPair(settings_.depth.weight, pairs.depth.size());
  for (const auto* contour : {&pairs.model_to_observed, &pairs.observed_to_model}) {
    double sum = 0.0;
    for (const ContourPair& pair : *contour)
      sum += Robust(Residual(pair, camera_, vertices[pair.vertex].cast<double>()), kernel_m);
    energies.contour += PerPair(settings_.contour.weight, contour->size()) * sum;
  }
  for (const Vector3d& change : PoseChange(pose, last))
    energies.pose_change += settings_.fit.pose_change_weight * change.squaredNorm();
  const auto turns = Unusualness(pose);
  for (int b = 1; b < kBoneCount; ++b) {
    energies.pose +=
        settings_.fit.pose_weight * turns[b].cwiseProduct(PerDeviation(b)).squaredNorm();
  }
  return energies;
}

NormalEquations FrameEnergy::Linearized(const Pairs& pairs, const std::vector<Vector3f>& vertices,
                                        const ScapePose& pose, const ScapePose& last,
                                        double kernel_m) const {
  NormalEquations equations;
  equations.hessian.setZero();
  equations.gradient.setZero();
  const ScapeBody::Linearization at = ScapeBody::LinearizeAt(pose);
  {
    RowSum sum(equations);
    const double depth_weight = PerPair(settings_.depth.weight, pairs.depth.size());
    for (const DepthPair& pair : pairs.depth) {
      const double r = Residual(pair, vertices[pair.vertex].cast<double>());
      sum.Add(depth_weight * RobustWeight(r, kernel_m), r,
              body_.RowOf(at, pair.vertex, Gradient(pair)));
    }
    for (const auto* contour : {&pairs.model_to_observed, &pairs.observed_to_model}) {
      const double weight = PerPair(settings_.contour.weight, contour->size());
      for (const ContourPair& pair : *contour) {
        const Vector3d vertex = vertices[pair.vertex].cast<double>();
        const double r = Residual(pair, camera_, vertex);
        sum.Add(weight * RobustWeight(r, kernel_m), r,
                body_.RowOf(at, pair.vertex, Gradient(pair, camera_, vertex)));
      }
    }
    const auto change = PoseChange(pose, last), turns = Unusualness(pose);
    for (int b = 1; b < kBoneCount; ++b) {
      AddTurn(b, settings_.fit.pose_change_weight, change[b], at.turn_by_own[b] / kChangeUnit_rad,
              sum);
      AddTurn(b, settings_.fit.pose_weight, turns[b].cwiseProduct(PerDeviation(b)),
              PerDeviation(b).asDiagonal() * InverseRightJacobian(turns[b]) *
                  pose.rotations[b].transpose(),
              sum);
    }
  }
  return equations;
}

FrameFit::FrameFit(const ScapeBody& body, const PinholeCamera& camera, const Settings& settings)
    : body_(body),
      settings_(settings),
      finder_(body.triangles(), body.vertex_count(), camera, settings),
      energy_(body, camera, settings) {}

FitResult FrameFit::Fit(const DepthImage& depth, const ScapePose& start, const ScapePose& last,
                        int iterations, std::vector<Vector3f>& vertices,
                        StepClock<TimedStep>& clock) {
  const std::vector<Eigen::Vector2d> observed = ObservedContour(depth, settings_.max_depth_m);
  FitResult fit;
  fit.pose = start;
  body_.Vertices(fit.pose, vertices);
  clock.Lap(TimedStep::kSurface);
  double damping = kFirstDamping;
  std::vector<Vector3f> stepped_vertices;
  while (fit.iterations < iterations && !fit.converged) {
    const double kernel_m = KernelAt(fit.iterations, iterations);
    ++fit.iterations;
    const Pairs& pairs = finder_.Find(vertices, depth, observed);
    clock.Lap(TimedStep::kRender);
    fit.energies = energy_.Of(pairs, vertices, fit.pose, last, kernel_m);
    const NormalEquations equations = energy_.Linearized(pairs, vertices, fit.pose, last, kernel_m);
    clock.Lap(TimedStep::kAssemble);
    bool improved = false;
    for (int tries = 0; tries < kTries && !improved; ++tries) {
      Eigen::MatrixXd damped = equations.hessian;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += kLeastDamping * kMm2PerM2;
      const Eigen::VectorXd step = -damped.ldlt().solve(equations.gradient);
      const ScapePose stepped = ScapeBody::Stepped(fit.pose, step);
      clock.Lap(TimedStep::kSolve);
      body_.Vertices(stepped, stepped_vertices);
      const Energies energies = energy_.Of(pairs, stepped_vertices, stepped, last, kernel_m);
      clock.Lap(TimedStep::kSurface);
      improved = energies.total() < fit.energies.total();
      damping =
          improved ? std::max(damping / kDampingFactor, kLeastDamping) : damping * kDampingFactor;
      if (!improved) continue;
      fit.pose = stepped;
      fit.energies = energies;
      vertices.swap(stepped_vertices);
      fit.converged = step.tail(3 * kBoneCount).cwiseAbs().maxCoeff() < settings_.fit.stop_rad;
    }
    if (!improved) {  // rest with these pairs and this kernel
      damping = kFirstDamping;
      fit.converged = kernel_m <= settings_.fit.last_kernel_m;
    }
  }
  const Pairs& pairs = finder_.Find(vertices, depth, observed);
  fit.supported = Supported(pairs, vertices);
  clock.Lap(TimedStep::kRender);
  return fit;
}

// Falls geometrically over the first half of the steps.
double FrameFit::KernelAt(int iteration, int iterations) const {
  const double half = std::max(1.0, 0.5 * iterations);
  const double done = std::min(1.0, iteration / half);
  return settings_.fit.first_kernel_m *
         std::pow(settings_.fit.last_kernel_m / settings_.fit.first_kernel_m, done);
}

double FrameFit::Supported(const Pairs& pairs, const std::vector<Vector3f>& vertices) const {
  if (pairs.visible == 0) return 0.0;
  const auto near = std::count_if(pairs.depth.begin(), pairs.depth.end(), [&](const DepthPair& p) {
    return std::abs(Residual(p, vertices[p.vertex].cast<double>())) < settings_.fit.last_kernel_m;
  });
  return static_cast<double>(near) / static_cast<double>(pairs.visible);
}

}  // namespace vitruvia::scape_regression
