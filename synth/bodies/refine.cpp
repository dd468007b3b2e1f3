// From a control body to a surface: subdivision, triangles, weight diffusion, decimation.
#include <algorithm>
#include <functional>

#include "core/error.h"
#include "geometry/decimation.h"
#include "synth/bodies/refiner.h"

namespace vitruvia {
namespace {

// The first corner's diagonal, whatever the shape: bodies of one topology then have the same
// triangles, and since subdivision puts each quad's old vertex first, left and right mirror.
std::vector<Triangle> SplitQuads(const std::vector<Quad>& quads) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (const auto& [a, b, c, d] : quads) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  return triangles;
}

// One step: each vertex keeps half of its weights and takes half of its neighbours' mean.
// Neighbours across a triangle edge count once for each of the edge's two triangles: evenly.
Eigen::MatrixXf Diffused(const Eigen::MatrixXf& weights, const std::vector<Triangle>& triangles) {
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(weights.rows(), weights.cols());
  Eigen::VectorXf counts = Eigen::VectorXf::Zero(weights.rows());
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int v = t[k], next = t[(k + 1) % 3], previous = t[(k + 2) % 3];
      sums.row(v) += weights.row(next) + weights.row(previous);
      counts[v] += 2.0f;
    }
  }
  Eigen::MatrixXf result = weights;
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    if (counts[v] > 0.0f) result.row(v) = 0.5f * (weights.row(v) + sums.row(v) / counts[v]);
  }
  return result;
}

constexpr int kFewestTargetVertices = 100;  // fewer look like no body

// The surface's vertices and the reference body's side by side: V × 6, so that both are subdivided
// alike. A body without a reference is its own.
Eigen::MatrixXf WithReference(const ControlBody& body) {
  const std::vector<Vector3f>& own = body.cage.vertices;
  const std::vector<Vector3f>& reference =
      body.reference_vertices.empty() ? own : body.reference_vertices;
  Require(reference.size() == own.size(), "Refine: {} reference vertices, expected {}",
          reference.size(), own.size());
  Eigen::MatrixXf positions(static_cast<Eigen::Index>(own.size()), 6);
  for (std::size_t v = 0; v < own.size(); ++v) {
    positions.row(v) << own[v].transpose(), reference[v].transpose();
  }
  return positions;
}

std::vector<Vector3f> VerticesIn(const Eigen::MatrixXf& positions, Eigen::Index first_column) {
  std::vector<Vector3f> vertices(positions.rows());
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    vertices[v] = positions.block<1, 3>(v, first_column).transpose();
  }
  return vertices;
}

// Keeps the vertices that decimating the reference body keeps.
void DecimateBody(const std::vector<Vector3f>& reference, int target_vertices, BodyModel& model) {
  Decimation decimation = Decimate({reference, model.rest.triangles}, target_vertices);
  // Kept vertices come in ascending order: each moves towards the front.
  for (std::size_t v = 0; v < decimation.kept.size(); ++v) {
    const auto old = static_cast<std::size_t>(decimation.kept[v]);
    model.rest.vertices[v] = model.rest.vertices[old];
    model.weights.bones[v] = model.weights.bones[old];
    model.weights.weights[v] = model.weights.weights[old];
  }
  model.rest.vertices.resize(decimation.kept.size());
  model.weights.bones.resize(decimation.kept.size());
  model.weights.weights.resize(decimation.kept.size());
  model.rest.triangles = std::move(decimation.triangles);
}

// If the fourth and fifth largest weights tie, as those of left and right on the midline do, both
// are removed, so that rounding does not choose a side.
void DropTiesForLastPlace(Eigen::MatrixXf& weights) {
  constexpr float kTie = 1e-6f;  // a few roundings of weights up to 1
  for (Eigen::Index v = 0; v < weights.rows(); ++v) {
    std::vector<float> sorted(weights.cols());
    for (Eigen::Index bone = 0; bone < weights.cols(); ++bone) sorted[bone] = weights(v, bone);
    std::partial_sort(sorted.begin(), sorted.begin() + kMaxInfluences + 1, sorted.end(),
                      std::greater<>());
    const float last_kept = sorted[kMaxInfluences - 1], first_dropped = sorted[kMaxInfluences];
    if (first_dropped == 0.0f || last_kept - first_dropped > kTie) continue;
    for (Eigen::Index bone = 0; bone < weights.cols(); ++bone) {
      if (weights(v, bone) <= last_kept + kTie) weights(v, bone) = 0.0f;
    }
  }
}

}  // namespace

void RefinementSettings::Describe(Fields& f) {
  f.Integer("subdivisions", subdivisions,
            {.meaning = "Catmull–Clark steps, of positions and skinning weights alike; each makes "
                        "four quads of one",
             .min = 0,
             .max = 4,
             .origin = Origin::kInput,
             .source = "the source's own mesh"});
  f.Integer(
      "weight_diffusion", weight_diffusion,
      {.meaning =
           "number of steps in which each vertex's skinning weights move half-way to the mean of "
           "its neighbours', so that the template's weights cannot reproduce the truth",
       .min = 0,
       .max = 100,
       .origin = Origin::kInput,
       .source = "none: the weights as subdivided"});
  f.Integer("target_vertices", target_vertices,
            {.meaning = "final decimation to this number of vertices, a subset of the subdivided "
                        "surface's with their weights; 0: no decimation",
             .min = 0,
             .max = 1e6,
             .origin = Origin::kInput,
             .source = "none: the mesh as subdivided"});
}

std::string RefinementSettings::Problem() const {
  if (target_vertices == 0 || target_vertices >= kFewestTargetVertices) return "";
  return fmt::format("target_vertices: expected 0 (all) or at least {}, got {}",
                     kFewestTargetVertices, target_vertices);
}

Refiner::Refiner(const QuadMesh& cage, const RefinementSettings& settings)
    : settings_(settings), quads_(cage.quads) {
  auto vertex_count = static_cast<int>(cage.vertices.size());
  for (int step = 0; step < settings.subdivisions; ++step) {
    steps_.push_back(CatmullClark(FinestQuads(), vertex_count));
    vertex_count = static_cast<int>(steps_.back().new_from_old.rows());
  }
}

void Refiner::RequireFits(const ControlBody& body) const {
  const auto vertex_count = static_cast<Eigen::Index>(body.cage.vertices.size());
  Require(body.weights.rows() == vertex_count && body.weights.cols() == kBoneCount,
          "Refine: weights are {} × {}, expected {} × {}", body.weights.rows(), body.weights.cols(),
          vertex_count, kBoneCount);
  Require(body.cage.quads == quads_, "Refine: the body {} has other quads than the cage",
          body.name);
}

const std::vector<Quad>& Refiner::FinestQuads() const {
  return steps_.empty() ? quads_ : steps_.back().quads;
}

Eigen::MatrixXf Refiner::Subdivided(Eigen::MatrixXf values) const {
  for (const SubdivisionStep& step : steps_) values = (step.new_from_old * values).eval();
  return values;
}

BodyModel Refiner::Refined(const ControlBody& body) const {
  RequireFits(body);
  const Eigen::MatrixXf positions = Subdivided(WithReference(body));
  BodyModel model;
  model.name = body.name;
  model.skeleton = body.skeleton;
  model.attributes = body.attributes;
  model.rest.triangles = SplitQuads(FinestQuads());
  model.rest.vertices = VerticesIn(positions, 0);
  Eigen::MatrixXf weights = Subdivided(body.weights);
  for (int step = 0; step < settings_.weight_diffusion; ++step) {
    weights = Diffused(weights, model.rest.triangles);
  }
  DropTiesForLastPlace(weights);
  model.weights = Sparsified(weights);
  if (settings_.target_vertices > 0) {
    DecimateBody(VerticesIn(positions, 3), settings_.target_vertices, model);
  }
  return model;
}

std::vector<Vector3f> Refiner::Vertices(const ControlBody& body) const {
  if (settings_.target_vertices > 0) return Refined(body).rest.vertices;
  RequireFits(body);
  return VerticesIn(Subdivided(WithReference(body)), 0);
}

BodyModel Refine(const ControlBody& body, const RefinementSettings& settings) {
  return Refiner(body.cage, settings).Refined(body);
}

RefinementSettings DefaultTemplateRefinement(BodySource source) {
  RefinementSettings settings;
  constexpr int kPaperVertices = 6250;
  if (source == BodySource::kMannequin) settings.subdivisions = 2;
  if (source == BodySource::kMakeHuman) settings.target_vertices = kPaperVertices;
  return settings;
}

}  // namespace vitruvia
