#include "learning/registration/registration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include "core/error.h"
#include "core/progress.h"
#include "fitting/depth_search.h"
#include "fitting/depth_target.h"
#include "math/rigid.h"

namespace vitruvia {
namespace {

constexpr int kCoarseSeekers = 500, kFineSeekers = 2000;
constexpr DepthTargetSettings kCoarseFrame{80, 2000, 400};
constexpr DepthTargetSettings kFineFrame{160, 6000, 1500};
constexpr double kLowest_m = 0.4, kHighest_m = 2.8;  // a child that crouches; raised arms
constexpr double kMostUnusual = 3.0;  // shape of known attributes, standard deviations

// The space's first coefficients, and as the last one a uniform scale about the vertices' mean.
ShapedBody WithScale(const ShapeSpace& space, int components, double scale_deviation) {
  ShapedBody body;
  body.triangles = space.reference.rest.triangles;
  body.weights = space.reference.weights;
  body.mean = Shape(space, Eigen::VectorXd());
  for (int b = 0; b < kBoneCount; ++b) {
    body.skeleton.joints[b] = space.joint_mean.segment<3>(3 * b);
    body.skeleton.tips[b] = space.joint_mean.segment<3>(3 * (kBoneCount + b));
  }
  body.basis.resize(space.mean.size(), components + 1);
  body.basis << space.basis.leftCols(components), space.mean * static_cast<float>(scale_deviation);
  body.joint_basis.resize(space.joint_mean.size(), components + 1);
  body.joint_basis << space.joint_basis.leftCols(components), space.joint_mean * scale_deviation;
  return body;
}

double HeightOf(const std::vector<Vector3f>& vertices) { return BoundingBox(vertices).sizes().y(); }

// The body's shapes that are as tall as the expected one, in coefficients about it: one fewer, and
// standard normal as before. The height is linear in the coefficients as long as the crown and the
// soles are at the same vertices.
ShapedBody AsTallAs(const ShapedBody& body, const Eigen::VectorXd& expected) {
  ShapedBody tall = body;
  tall.mean = ShapedSurface(body, expected);
  tall.skeleton = ShapedSkeleton(body, expected);
  const auto [sole, crown] =
      std::minmax_element(tall.mean.begin(), tall.mean.end(),
                          [](const Vector3f& a, const Vector3f& b) { return a.y() < b.y(); });
  const auto y_of = [&](auto vertex) {
    return body.basis.row(3 * (vertex - tall.mean.begin()) + 1);
  };
  const Eigen::VectorXd taller = (y_of(crown) - y_of(sole)).transpose().cast<double>();
  const Eigen::MatrixXd directions = Eigen::HouseholderQR<Eigen::MatrixXd>(taller).householderQ();
  const Eigen::MatrixXd level = directions.rightCols(body.shape_count() - 1);
  tall.basis = body.basis * level.cast<float>();
  tall.joint_basis = body.joint_basis * level;
  return tall;
}

}  // namespace

void RegistrationSettings::Describe(Fields& f) {
  f.Integer("components", components,
            {.meaning = "coefficients of the shape space that are fitted to a surface",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Number("scale_deviation", scale_deviation,
           {.meaning = "standard deviation of a body's uniform scale, which is fitted besides the "
                       "shape space's coefficients",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "statures vary by 4 % among adults; children are outside of most spaces"});
  f.Choice("clothing", clothing, {{"none", Clothing::kNone}, {"loose", Clothing::kLoose}},
           {.meaning = "clothing of the person; loose: the body may lie inside the surface at a "
                       "lower cost than outside",
            .origin = Origin::kGuessed});
  search.Describe(f);
  f.Integer("surface_points", surface_points,
            {.meaning = "number of evenly spread points by which a surface is sampled",
             .min = 500,
             .max = 1000000,
             .origin = Origin::kGuessed});
  f.Number("most_distance_m", most_distance_m,
           {.meaning = "largest mean distance of body and surface for the surface to be a person's",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

Registrar::Registrar(const ShapeSpace& space, const KnownAttributes& known,
                     const RegistrationSettings& settings)
    : space_(space), settings_(settings), known_(known) {
  if (settings.components > space.components()) {
    throw ConfigError(
        fmt::format("registration: components: expected at most the {} of the shape space, got {}",
                    space.components(), settings.components));
  }
  expected_ = ShapeOfSize(space, known, settings.components, kMostUnusual);
  body_ = WithScale(space, settings.components, settings.scale_deviation);
  if (known.height_m) body_ = AsTallAs(body_, ScaledShape(expected_.scale));
  fine_body_ = Coarser(body_, settings.search.fine_vertices);
  coarse_body_ = Coarser(body_, settings.search.coarse_vertices);
  fine_ = std::make_unique<PoseFit>(fine_body_);
  coarse_ = std::make_unique<PoseFit>(coarse_body_);
}

Registrar::~Registrar() = default;

FitPriors Registrar::Priors() const {
  FitPriors priors;
  priors.angle_deviation_deg = settings_.search.angle_deviation_deg;
  return priors;
}

NearFar Registrar::Limits() const { return {settings_.search.near_m, settings_.search.far_m}; }

Eigen::VectorXd Registrar::ScaledShape(double scale) const {
  Eigen::VectorXd theta(settings_.components + 1);
  theta << scale * expected_.theta, (scale - 1.0) / settings_.scale_deviation;
  return theta;
}

Eigen::VectorXd Registrar::ExpectedShape() const {
  return known_.height_m ? Eigen::VectorXd(Eigen::VectorXd::Zero(body_.shape_count()))
                         : ScaledShape(1.0);
}

// The expected shape; if the height is not known, it is scaled so that the posed body has the
// height of the measurements.
Eigen::VectorXd Registrar::StartShape(const PoseHypothesis& hypothesis, double height_m) const {
  if (known_.height_m) return ExpectedShape();
  BodyState state = hypothesis.state;
  state.theta = ScaledShape(1.0);
  PosedBody posed(coarse_body_);
  posed.Set(state);
  constexpr double kLeastHeight_m = 0.7, kMostHeight_m = 2.2;
  const double standing_m = HeightOf(ShapedSurface(coarse_body_, state.theta));
  return ScaledShape(std::clamp(height_m / HeightOf(posed.vertices()), kLeastHeight_m / standing_m,
                                kMostHeight_m / standing_m));
}

std::vector<PoseHypothesis> Registrar::Hypotheses(const Matrix3<double>& world_from_front,
                                                  double height_m) const {
  std::vector<PoseHypothesis> hypotheses =
      StartHypotheses(world_from_front, settings_.search.headings, Eigen::VectorXd());
  for (PoseHypothesis& h : hypotheses) h.state.theta = StartShape(h, height_m);
  return hypotheses;
}

Registration Registrar::Judged(const SearchOutcome& found, const NearFar& limits) const {
  Registration registration{found.best.state, found.best.distance, found.margin,
                            fmt::format("{}, heading {:.0f} degrees", found.best.start->pose,
                                        found.best.start->heading_deg),
                            ""};
  Judge(registration, limits);
  return registration;
}

Registration Registrar::Find(const TriangleMesh& surface) {
  const double height_m = HeightOf(surface.vertices);
  if (height_m < kLowest_m || height_m > kHighest_m) {
    Registration none;
    none.problem = fmt::format(
        "no person: the surface is {:.4g} m high, expected {:g} to {:g} m. Is it y up, in metres?",
        height_m, kLowest_m, kHighest_m);
    return none;
  }
  const OrientedPoints points = SampleSurface(surface, settings_.surface_points);
  SurfaceTarget coarse_target(points, kCoarseSeekers, settings_.clothing);
  SurfaceTarget fine_target(points, kFineSeekers, settings_.clothing);
  const std::vector<PoseHypothesis> hypotheses = Hypotheses(Matrix3<double>::Identity(), height_m);
  return Judged(SearchPose(hypotheses,
                           {{coarse_.get(), &coarse_target, {6, 0.5, 0.25, 0.5, false}, 20},
                            {coarse_.get(), &coarse_target, {10, 0.3, 0.12, 0.2, true}, 6},
                            {fine_.get(), &fine_target, {15, 0.15, 0.05, 0.05, true}, 2}},
                           Priors(), Limits()),
                Limits());
}

Registration Registrar::Find(const DepthImage& depth, const PinholeCamera& camera) {
  DepthTarget coarse_target(depth, camera, kCoarseFrame);
  DepthTarget fine_target(depth, camera, kFineFrame);
  if (coarse_target.is_empty() || fine_target.is_empty()) {
    Registration none;
    none.problem = "no person: the frame holds too few measurements";
    return none;
  }
  const Matrix3<double> facing_camera = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const std::vector<PoseHypothesis> hypotheses = Hypotheses(facing_camera, fine_target.height_m());
  SearchOutcome found =
      SearchDepth(hypotheses, {coarse_.get(), fine_.get(), &coarse_target, &fine_target, true},
                  Priors(), Limits());
  const NearFar limits = settings_.search.LimitsAt(fine_target.Center().z());
  found.best.distance = fine_->Measure(fine_target, found.best.state, limits);
  return Judged(found, limits);
}

std::vector<Registration> Registrar::FindSame(const std::vector<DepthImage>& frames,
                                              const PinholeCamera& camera) {
  constexpr int kRounds = 6;
  constexpr FitStage kPoses{4, 0.08, 0.05, 0.05, false};
  std::vector<Registration> found;
  Progress progress("register", static_cast<int>(frames.size()));
  for (const DepthImage& frame : frames) {
    found.push_back(Find(frame, camera));
    if (!found.back().problem.empty()) return found;
    progress.Advance();
  }
  if (frames.size() == 1) return found;
  std::vector<DepthTarget> targets;
  for (const DepthImage& frame : frames) targets.emplace_back(frame, camera, kFineFrame);
  FitPriors priors = Priors();
  priors.theta = ExpectedShape();
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(priors.theta.size());
  for (const Registration& r : found) theta += r.state.theta / static_cast<double>(found.size());
  for (int round = 0; round <= kRounds; ++round) {
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Identity(theta.size(), theta.size());
    Eigen::VectorXd gradient = theta - priors.theta;
    for (std::size_t f = 0; f < found.size(); ++f) {
      BodyState& state = found[f].state;
      state.theta = theta;
      priors.angles_deg = state.angles_deg;
      state = fine_->Run(targets[f], state, kPoses, priors);
      const ShapeEquations equations = fine_->EquationsOfShape(targets[f], state, kPoses, priors);
      hessian += equations.hessian;
      gradient += equations.gradient;
    }
    if (round < kRounds) theta -= hessian.ldlt().solve(gradient);
  }
  for (std::size_t f = 0; f < found.size(); ++f) {
    const NearFar limits = settings_.search.LimitsAt(targets[f].Center().z());
    found[f].distance = fine_->Measure(targets[f], found[f].state, limits);
    Judge(found[f], limits);
  }
  return found;
}

Registration Registrar::Follow(const TriangleMesh& surface, const BodyState& near) {
  SurfaceTarget target(SampleSurface(surface, settings_.surface_points), kFineSeekers,
                       settings_.clothing);
  FitPriors priors = Priors();
  priors.angles_deg = near.angles_deg;
  priors.theta = near.theta;
  Registration registration;
  registration.state = coarse_->Run(target, near, {6, 0.3, 0.1, 0.2, false}, priors);
  registration.state = fine_->Run(target, registration.state, {6, 0.1, 0.05, 0.05, false}, priors);
  registration.distance = fine_->Measure(target, registration.state, Limits());
  registration.start = "the frame before";
  Judge(registration, Limits());
  return registration;
}

void Registrar::Judge(Registration& registration, const NearFar& limits) const {
  const MutualDistance& d = registration.distance;
  if (d.target_explained >= settings_.search.least_explained &&
      d.body_explained >= settings_.search.least_explained &&
      d.mean_m() <= settings_.most_distance_m) {
    return;
  }
  registration.problem = fmt::format(
      "no person: the body explains {:.0f} % of the surface, and the surface {:.0f} % of the body "
      "(expected at least {:.0f} % within {:.2g} m); mean distance {:.1f} mm (expected at most "
      "{:.1f} mm). Is it one whole person, y up, in metres?",
      100.0 * d.target_explained, 100.0 * d.body_explained,
      100.0 * settings_.search.least_explained, limits.near_m, 1e3 * d.mean_m(),
      1e3 * settings_.most_distance_m);
}

BodyModel Registrar::Body(const Eigen::VectorXd& theta) const {
  BodyModel body = space_.reference;
  body.rest.vertices = ShapedSurface(body_, theta);
  body.skeleton = ShapedSkeleton(body_, theta);
  const Vector3f lift(0.0f, -BoundingBox(body.rest.vertices).min().y(), 0.0f);
  for (Vector3f& v : body.rest.vertices) v += lift;
  for (int b = 0; b < kBoneCount; ++b) {
    body.skeleton.joints[b] += lift.cast<double>();
    body.skeleton.tips[b] += lift.cast<double>();
  }
  const Sex sex = known_.sex.value_or(Sex::kMale);
  body.attributes = {HeightOf(body.rest.vertices),
                     EnclosedVolume(body.rest) * space_.density_kg_m3[SexIndex(sex)], sex};
  return body;
}

BoneTransforms Registrar::SurfaceFromSubject(const BodyState& state) const {
  const Skeleton subject = Body(state.theta).skeleton;
  BoneTransforms transforms = WorldFromRest(fine_body_, state);
  const Skeleton centred = ShapedSkeleton(fine_body_, state.theta);
  const Vector3d centred_from_subject = centred.joints[0] - subject.joints[0];
  for (Rigidd& t : transforms) t.translation += t.rotation * centred_from_subject;
  return transforms;
}

}  // namespace vitruvia
