#include "synth/bodies/mannequin.h"

#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "body/subdivision.h"
#include "core/error.h"
#include "synth/bodies/mannequin_cage.h"
#include "synth/bodies/mannequin_score.h"
#include "synth/bodies/mannequin_shape.h"
#include "synth/bodies/mannequin_tables.h"
#include "synth/bodies/mannequin_weights.h"

namespace vitruvia {
namespace {

// Range of weight over cubed stature in which the shape does not self-intersect (checked by tests),
// slightly larger than the range of living people. The survey's means are near 15.8.
constexpr double kLeastRohrerIndex = 7.5, kGreatestRohrerIndex = 28.0;  // kg/m³

// The surface after kMannequinSteps, as a linear function of the cage.
class Refinement {
 public:
  Refinement() {
    const mannequin::Cage& cage = mannequin::TheCage();
    const int count = cage.vertex_count();
    quads_ = cage.quads;
    fine_from_cage_.resize(count, count);
    fine_from_cage_.setIdentity();
    for (int step = 0; step < kMannequinSteps; ++step) {
      SubdivisionStep finer = CatmullClark(quads_, static_cast<int>(fine_from_cage_.rows()));
      fine_from_cage_ = (finer.new_from_old.cast<double>() * fine_from_cage_).eval();
      quads_ = std::move(finer.quads);
    }
    // Subdivision keeps the old vertices first.
    const Eigen::MatrixXd kept = Eigen::MatrixXd(fine_from_cage_.topRows(count));
    cage_from_surface_.compute(kept);
  }

  // The cage whose refined surface passes through a point for each of its vertices (Halstead, Kass
  // & DeRose 1993, without their fairness term).
  Eigen::MatrixX3d CageThrough(const Eigen::MatrixX3d& surface) const {
    return cage_from_surface_.solve(surface);
  }
  Eigen::MatrixX3d Fine(const Eigen::MatrixX3d& cage) const { return fine_from_cage_ * cage; }

  double Volume(const Eigen::MatrixX3d& fine) const {
    double six_volumes = 0.0;
    const auto add = [&](int a, int b, int c) {
      const Vector3d p = fine.row(a), q = fine.row(b), r = fine.row(c);
      six_volumes += p.dot(q.cross(r));
    };
    for (const auto& [a, b, c, d] : quads_) {
      add(a, b, c);
      add(a, c, d);
    }
    return six_volumes / 6.0;
  }

 private:
  std::vector<Quad> quads_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> fine_from_cage_;
  Eigen::PartialPivLU<Eigen::MatrixXd> cage_from_surface_;
};

const Refinement& TheRefinement() {
  static const Refinement refinement;
  return refinement;
}

Eigen::MatrixX3d Mirrored(const Eigen::MatrixX3d& left) {
  const mannequin::Cage& cage = mannequin::TheCage();
  Eigen::MatrixX3d both(cage.vertex_count(), 3);
  for (int v = 0; v < mannequin::kLeftVertices; ++v) {
    both.row(v) = left.row(v);
    if (cage.mirror[v] == v) {
      both(v, 0) = 0.0;
    } else {
      both.row(cage.mirror[v]) << -left(v, 0), left(v, 1), left(v, 2);
    }
  }
  return both;
}

struct Figure {
  Eigen::MatrixX3d cage;
  Skeleton skeleton;
  double volume_m3 = 0.0;
};

// The subject of that stature whose girths have that score.
Figure MakeFigure(Sex sex, double height_m, double girth_score) {
  const mannequin::Form form = mannequin::MakeForm(sex, girth_score);
  const Refinement& refinement = TheRefinement();
  Figure figure;
  figure.cage =
      Mirrored(refinement.CageThrough(Mirrored(form.surface)).topRows(mannequin::kLeftVertices));
  const Eigen::MatrixX3d fine = refinement.Fine(figure.cage);
  const double floor = fine.col(1).minCoeff(), top = fine.col(1).maxCoeff();
  // The same factor in all directions but for the crown's and the soles' last tenths of a
  // millimetre, which lie between the designed points.
  const double scale = height_m / mannequin::Survey(sex).stature_m;
  const double upwards = height_m / (top - floor);
  const Eigen::RowVector3d factors(scale, upwards, scale);
  figure.cage.col(1).array() -= floor;
  figure.cage = figure.cage.array().rowwise() * factors.array();
  figure.volume_m3 = refinement.Volume(fine) * factors.prod();
  figure.skeleton = form.skeleton;
  for (auto* points : {&figure.skeleton.joints, &figure.skeleton.tips}) {
    for (Vector3d& p : *points) {
      p.y() -= floor;
      p = p.cwiseProduct(factors.transpose());
    }
  }
  return figure;
}

Figure FigureOfVolume(Sex sex, double height_m, double volume_m3) {
  const auto volume_at = [&](double score) { return MakeFigure(sex, height_m, score).volume_m3; };
  return MakeFigure(sex, height_m, mannequin::ScoreOfVolume(volume_at, volume_m3));
}

}  // namespace

// Guessed within the range of densitometry: without the air in lungs and bowels about 1,060 (lean)
// to 1,030 kg/m³, with it about 5 % less; women carry more fat.
double BodyDensity(Sex sex) { return sex == Sex::kMale ? 1005.0 : 1000.0; }

std::string MannequinProblem(const BodySettings& settings) {
  const double cube = settings.height_m * settings.height_m * settings.height_m;
  const double least = kLeastRohrerIndex * cube, greatest = kGreatestRohrerIndex * cube;
  if (settings.weight_kg >= least && settings.weight_kg <= greatest) return "";
  return fmt::format(
      "no mannequin of height {} m weighs {} kg; expected a weight of {:.1f} … {:.1f} kg "
      "at that height ({} … {} kg per cubed metre of height)",
      settings.height_m, settings.weight_kg, least, greatest, kLeastRohrerIndex,
      kGreatestRohrerIndex);
}

ControlBody MakeMannequin(const BodySettings& settings) {
  if (const std::string problem = MannequinProblem(settings); !problem.empty()) {
    throw ConfigError(problem);
  }
  const Figure figure = FigureOfVolume(settings.sex, settings.height_m,
                                       settings.weight_kg / BodyDensity(settings.sex));
  ControlBody body;
  body.name = "mannequin";
  body.cage.quads = mannequin::TheCage().quads;
  body.cage.vertices.resize(figure.cage.rows());
  for (Eigen::Index v = 0; v < figure.cage.rows(); ++v) {
    body.cage.vertices[v] = figure.cage.row(v).transpose().cast<float>();
  }
  body.weights = mannequin::CageWeights();
  body.skeleton = figure.skeleton;
  body.attributes = {settings.height_m, settings.weight_kg, settings.sex};
  return body;
}

}  // namespace vitruvia
