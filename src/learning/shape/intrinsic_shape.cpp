#include "learning/shape/intrinsic_shape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/error.h"
#include "math/angles.h"
#include "search/kd_tree.h"

namespace vitruvia {
namespace {

constexpr double kMostHeightMismatch_m = 0.25;  // scan against person: arms up, cut off, not them

// One pair: vertex `vertex` of the body against `target`, along n.
struct Pair {
  int vertex;
  Vector3f target, n;
};

void CheckScan(const ScannedSurface& scan, const BodyAttributes& attributes) {
  Require(scan.points.size() == scan.normals.size(), "FitIntrinsicShape: {} points, {} normals",
          scan.points.size(), scan.normals.size());
  if (scan.points.empty()) throw DataError("intrinsic shape: the scan is empty: there is no body");
  const double height_m = BoundingBox(scan.points).sizes().y();
  if (std::abs(height_m - attributes.height_m) > kMostHeightMismatch_m) {
    throw DataError(fmt::format(
        "intrinsic shape: the scan is {:.2f} m high, the person {:.2f} m; expected them to differ "
        "by at most {:.2f} m (is the scan cut off, or of somebody else?)",
        height_m, attributes.height_m, kMostHeightMismatch_m));
  }
}

// The fit: state and the named steps of one iteration.
class Fit {
 public:
  Fit(const ShapeSpace& space, const ShapeSpace& tracking, const ScannedSurface& scan,
      const BodyAttributes& attributes, const IntrinsicShapeSettings& settings)
      : settings_(settings),
        attributes_(attributes),
        subspace_(space, settings.components),
        posed_(tracking, settings.components),
        tracking_(tracking),
        scan_(scan),
        queries_(EvenlyChosen(scan, settings.scan_points)) {
    scan_tree_.Build(scan.points);
    parameters_ = posed_.Start();
    if (Holds()) {
      CheckAttributes(space);
      parameters_.theta = subspace_.Corrected(subspace_.Nearest(attributes), attributes);
    }
    moves_ = Holds() ? subspace_.orthogonal()
                     : Eigen::MatrixXd::Identity(settings.components, settings.components);
    center_ = parameters_.theta;
    PlaceOnScan();
  }

  IntrinsicShape Run() {
    IntrinsicShape result;
    for (; result.iterations < settings_.max_iterations && !result.converged; ++result.iterations) {
      posed_.Set(parameters_);
      FindPairs(Cutoff(result.iterations));
      Assemble();
      result.converged = Step() < settings_.stop_m && AtLastCutoff(result.iterations);
    }
    posed_.Set(parameters_);
    FindPairs(settings_.last_cutoff_m);
    Summarize(result);
    return result;
  }

 private:
  bool Holds() const { return settings_.attributes == AttributeUse::kHeld; }

  void CheckAttributes(const ShapeSpace& space) const {
    const double deviation = subspace_.Deviation(attributes_);
    if (deviation <= settings_.most_unusual) return;
    throw ConfigError(fmt::format(
        "intrinsic shape: a {} of {:.2f} m and {:.1f} kg is {:.1f} standard deviations from the "
        "database's mean ({:.2f} m, {:.1f} kg); expected at most {:g} (most_unusual)",
        attributes_.sex == Sex::kMale ? "man" : "woman", attributes_.height_m,
        attributes_.weight_kg, deviation, space.attribute_mean[0], space.attribute_mean[1],
        settings_.most_unusual));
  }

  // Head to head, and the middle of the body over the middle of the scan: soles may be missing.
  void PlaceOnScan() {
    posed_.Set(parameters_);
    const Eigen::AlignedBox3f body = BoundingBox(posed_.vertices());
    const Eigen::AlignedBox3f scan = BoundingBox(scan_.points);
    Vector3f shift = scan.center() - body.center();
    shift.y() = scan.max().y() - body.max().y();
    parameters_.pelvis_position += shift.cast<double>();
  }

  double Cutoff(int iteration) const {
    const double share =
        std::min(1.0, static_cast<double>(iteration) / (0.5 * settings_.max_iterations));
    return settings_.first_cutoff_m *
           std::pow(settings_.last_cutoff_m / settings_.first_cutoff_m, share);
  }
  bool AtLastCutoff(int iteration) const { return 2 * iteration >= settings_.max_iterations; }

  // Finds pairs in both directions: body vertices with the scan's planes, and scan points with the
  // body's planes.
  void FindPairs(double cutoff_m) {
    const std::vector<Vector3f>& vertices = posed_.vertices();
    ComputeVertexNormals(vertices, tracking_.reference.rest.triangles, normals_);
    const auto least_cosine =
        static_cast<float>(std::cos(settings_.normal_angle_deg * kRadiansPerDegree));
    const auto cutoff = static_cast<float>(cutoff_m);
    pairs_.clear();
    scan_tree_.FindNearest(vertices, cutoff, neighbors_);
    covered_.assign(vertices.size(), false);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (neighbors_[v].index < 0) continue;
      const auto s = static_cast<std::size_t>(neighbors_[v].index);
      if (scan_.normals[s].dot(normals_[v]) < least_cosine) continue;
      pairs_.push_back({static_cast<int>(v), scan_.points[s], scan_.normals[s]});
      covered_[v] = true;
    }
    body_pairs_ = pairs_.size();
    body_tree_.Build(vertices);
    body_tree_.FindNearest(queries_.points, cutoff, neighbors_);
    for (std::size_t q = 0; q < queries_.points.size(); ++q) {
      if (neighbors_[q].index < 0) continue;
      const auto v = static_cast<std::size_t>(neighbors_[q].index);
      if (queries_.normals[q].dot(normals_[v]) < least_cosine) continue;
      pairs_.push_back({neighbors_[q].index, queries_.points[q], normals_[v]});
    }
  }

  float Residual(const Pair& pair) const {
    return pair.n.dot(posed_.vertices()[static_cast<std::size_t>(pair.vertex)] - pair.target);
  }

  // Normal equations of λ₁ E_diff: blocks of weighted rows, each added as one product.
  void Assemble() {
    const int columns = posed_.parameter_count();
    constexpr int kRows = 256;
    rows_.resize(kRows, columns);
    residuals_.resize(kRows);
    hessian_.setZero(columns, columns);
    gradient_.setZero(columns);
    const auto scale = static_cast<float>(std::sqrt(settings_.lambda) / settings_.length_unit_m);
    const auto robust = static_cast<float>(settings_.robust_m);
    for (std::size_t first = 0; first < pairs_.size(); first += kRows) {
      const auto count = static_cast<int>(std::min<std::size_t>(kRows, pairs_.size() - first));
      for (int i = 0; i < count; ++i) {
        const Pair& pair = pairs_[first + static_cast<std::size_t>(i)];
        posed_.Row(static_cast<std::size_t>(pair.vertex), pair.n, rows_.row(i).data());
        const float residual = Residual(pair), relative = residual / robust;
        const float weight = scale / (1.0f + relative * relative);  // Geman–McClure's square root
        rows_.row(i) *= weight;
        residuals_[i] = weight * residual;
      }
      const auto block = rows_.topRows(count);
      hessian_.selfadjointView<Eigen::Lower>().rankUpdate(block.transpose());
      gradient_.noalias() += block.transpose() * residuals_.head(count);
    }
  }

  // One Gauss–Newton step; the surface's mean movement in metres.
  double Step() {
    const int components = settings_.components, free = static_cast<int>(moves_.cols());
    const int columns = free + posed_.parameter_count() - components;
    // From θ to the subspace in which it may move; poses stay.
    Eigen::MatrixXd reduction = Eigen::MatrixXd::Zero(posed_.parameter_count(), columns);
    reduction.topLeftCorner(components, free) = moves_;
    reduction.bottomRightCorner(columns - free, columns - free).setIdentity();
    const Eigen::MatrixXd full =
        hessian_.selfadjointView<Eigen::Lower>()
            .
            operator*(Eigen::MatrixXf::Identity(hessian_.rows(), hessian_.cols()))
            .cast<double>();
    Eigen::MatrixXd hessian = reduction.transpose() * full * reduction;
    Eigen::VectorXd gradient = reduction.transpose() * gradient_.cast<double>();
    // E_ap, and the prior on every joint's rotation but the pelvis'.
    hessian.topLeftCorner(free, free).diagonal().array() += 1.0;
    gradient.head(free) += moves_.transpose() * (parameters_.theta - center_);
    const double slack = 1.0 / std::pow(settings_.pose_slack_deg * kRadiansPerDegree, 2);
    const std::array<Vector3d, kBoneCount> bends = PosedShape::BendGradients(parameters_);
    for (int b = 1; b < kBoneCount; ++b) {
      const int at = free + posed_.rotation_index(b) - components;
      hessian.block<3, 3>(at, at).diagonal().array() += slack;
      gradient.segment<3>(at) += slack * bends[b];
    }
    const Eigen::VectorXd step = reduction * hessian.ldlt().solve(-gradient);
    parameters_ = posed_.Stepped(parameters_, step);
    if (Holds()) Recenter();
    return MeanMovement();
  }

  // Corrects height and weight; E_ap is measured from the shape that meets the attributes.
  void Recenter() {
    const Eigen::VectorXd before = parameters_.theta;
    parameters_.theta = subspace_.Corrected(before, attributes_);
    center_ += parameters_.theta - before;
  }

  double MeanMovement() {
    const std::vector<Vector3f> before = posed_.vertices();
    posed_.Set(parameters_);
    double sum = 0.0;
    for (std::size_t v = 0; v < before.size(); ++v)
      sum += (posed_.vertices()[v] - before[v]).norm();
    return sum / static_cast<double>(before.size());
  }

  void Summarize(IntrinsicShape& result) const {
    result.theta = parameters_.theta;
    result.pose = parameters_;
    result.in_scan = posed_.vertices();
    double sums[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      sums[i < body_pairs_ ? 0 : 1] += std::abs(Residual(pairs_[i]));
    const auto of = [](double sum, std::size_t count) {
      return count == 0 ? 0.0 : sum / static_cast<double>(count);
    };
    result.body_to_scan_mean_m = of(sums[0], body_pairs_);
    result.scan_to_body_mean_m = of(sums[1], pairs_.size() - body_pairs_);
    std::array<int, kBoneCount> all{}, covered{};
    for (std::size_t v = 0; v < covered_.size(); ++v) {
      const std::size_t bone = tracking_.reference.weights.bones[v][0];
      ++all[bone];
      if (covered_[v]) ++covered[bone];
    }
    for (int b = 0; b < kBoneCount; ++b) {
      result.coverage[b] = all[b] == 0 ? 0.0 : static_cast<double>(covered[b]) / all[b];
      if (all[b] == 0 || result.coverage[b] >= settings_.least_coverage) continue;
      throw DataError(fmt::format(
          "intrinsic shape: the scan covers {:.0f} % of the {}, expected at least {:.0f} % "
          "(least_coverage): a hole is there, or the fit did not find it",
          100.0 * result.coverage[b], Bones()[b].name, 100.0 * settings_.least_coverage));
    }
  }

  IntrinsicShapeSettings settings_;
  BodyAttributes attributes_;
  AttributeSubspace subspace_;
  PosedShape posed_;
  const ShapeSpace& tracking_;
  const ScannedSurface& scan_;
  ScannedSurface queries_;  // points that look for the body
  KdTree scan_tree_, body_tree_;
  PosedShape::Parameters parameters_;
  Eigen::MatrixXd moves_;   // K × F: the directions in which θ may move
  Eigen::VectorXd center_;  // of E_ap
  std::vector<Vector3f> normals_;
  std::vector<KdTree::Neighbor> neighbors_;
  std::vector<bool> covered_;
  std::vector<Pair> pairs_;
  std::size_t body_pairs_ = 0;  // the first ones: from the body to the scan
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;
  Eigen::VectorXf residuals_, gradient_;
  Eigen::MatrixXf hessian_;
};

}  // namespace

void IntrinsicShapeSettings::Describe(Fields& f) {
  f.Integer("components", components,
            {.meaning = "coefficients of the shape space that are searched",
             .min = kAttributeCount + 1,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Number("lambda", lambda,
           {.meaning = "weight of the distance to the scan against the prior, λ₁",
            .min = 0.0,
            .max = 1e6,
            .origin = Origin::kPaper,
            .source = "paper A, eq. 6"});
  f.Number("length_unit_m", length_unit_m,
           {.meaning = "length that counts as 1 in the distance between body and scan (E_diff)",
            .unit = "m",
            .min = 1e-4,
            .max = 10.0,
            .origin = Origin::kGuessed,
            .source = "the paper gives no unit; the tracker's"});
  f.Integer(
      "max_iterations", max_iterations,
      {.meaning = "maximum number of Gauss–Newton steps; the cutoff shrinks during the first half",
       .min = 1,
       .max = 1000,
       .origin = Origin::kGuessed});
  f.Number("first_cutoff_m", first_cutoff_m,
           {.meaning = "maximum distance between the points of a pair in the first step",
            .unit = "m",
            .min = 0.001,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number(
      "last_cutoff_m", last_cutoff_m,
      {.meaning = "maximum distance between the points of a pair in the second half of the steps",
       .unit = "m",
       .min = 0.001,
       .max = 1.0,
       .origin = Origin::kGuessed});
  f.Number("normal_angle_deg", normal_angle_deg,
           {.meaning = "maximum angle between the normals of a pair",
            .unit = "deg",
            .min = 1.0,
            .max = 90.0,
            .origin = Origin::kGuessed});
  f.Number("robust_m", robust_m,
           {.meaning = "distance at which a pair's weight has fallen to a quarter",
            .unit = "m",
            .min = 1e-4,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Number("pose_slack_deg", pose_slack_deg,
           {.meaning = "standard deviation of a joint's rotation from the T-pose",
            .unit = "deg",
            .min = 1e-3,
            .max = 90.0,
            .origin = Origin::kGuessed});
  f.Number("stop_m", stop_m,
           {.meaning = "the fit ends when a step moves the surface by less than this on average",
            .unit = "m",
            .min = 0.0,
            .max = 0.1,
            .origin = Origin::kGuessed});
  f.Integer("scan_points", scan_points,
            {.meaning = "number of scan points, evenly spaced, that are paired with the body",
             .min = 100,
             .max = 1000000,
             .origin = Origin::kGuessed});
  f.Number("least_coverage", least_coverage,
           {.meaning = "share of each bone's surface that the scan must cover",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number(
      "most_unusual", most_unusual,
      {.meaning =
           "maximum distance of the attributes from the database's mean, in standard deviations",
       .min = 0.0,
       .max = 100.0,
       .origin = Origin::kGuessed});
  f.Choice("attributes", attributes,
           {{"held", AttributeUse::kHeld}, {"ignored", AttributeUse::kIgnored}},
           {.meaning = "whether height, weight and sex are held at the person's known values",
            .origin = Origin::kPaper,
            .source = "paper A, eq. 6"});
}

std::string IntrinsicShapeSettings::Problem() const {
  if (last_cutoff_m <= first_cutoff_m) return "";
  return fmt::format("last_cutoff_m {:g} is above first_cutoff_m {:g}", last_cutoff_m,
                     first_cutoff_m);
}

ScannedSurface SurfaceOf(const TriangleMesh& scan) {
  ScannedSurface surface;
  surface.points = scan.vertices;
  ComputeVertexNormals(scan.vertices, scan.triangles, surface.normals);
  return surface;
}

IntrinsicShape FitIntrinsicShape(const ShapeSpace& space, const ShapeSpace& tracking,
                                 const ScannedSurface& scan, const BodyAttributes& attributes,
                                 const IntrinsicShapeSettings& settings) {
  CheckScan(scan, attributes);
  if (settings.components > space.components()) {
    throw ConfigError(fmt::format(
        "fit: components: expected at most the {} of the shape space, got {}; give settings with "
        "fewer, or learn a space with more",
        space.components(), settings.components));
  }
  return Fit(space, tracking, scan, attributes, settings).Run();
}

}  // namespace vitruvia
