// From a control body to a surface: subdivision, weight diffusion, triangles.
#include <fmt/format.h>

#include "core/error.h"
#include "geometry/subdivision.h"
#include "synth/bodies/body_source.h"

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
      {.meaning = "steps in which each vertex's skinning weights move half-way to the mean of "
                  "its neighbours': makes truth that the template's weights cannot fit",
       .min = 0,
       .max = 100,
       .origin = Origin::kInput,
       .source = "none: the weights as subdivided"});
}

BodyModel Refine(const ControlBody& body, const RefinementSettings& settings) {
  const auto vertex_count = static_cast<Eigen::Index>(body.cage.vertices.size());
  Require(body.weights.rows() == vertex_count && body.weights.cols() == kBoneCount,
          "Refine: weights are {} × {}, expected {} × {}", body.weights.rows(), body.weights.cols(),
          vertex_count, kBoneCount);
  Eigen::MatrixXf positions(vertex_count, 3), weights = body.weights;
  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    positions.row(v) = body.cage.vertices[v].transpose();
  }
  std::vector<Quad> quads = body.cage.quads;
  for (int step = 0; step < settings.subdivisions; ++step) {
    SubdivisionStep finer = CatmullClark(quads, static_cast<int>(positions.rows()));
    positions = (finer.new_from_old * positions).eval();
    weights = (finer.new_from_old * weights).eval();
    quads = std::move(finer.quads);
  }

  BodyModel model;
  model.name = body.name;
  model.skeleton = body.skeleton;
  model.attributes = body.attributes;
  model.rest.triangles = SplitQuads(quads);
  model.rest.vertices.resize(positions.rows());
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    model.rest.vertices[v] = positions.row(v).transpose();
  }
  for (int step = 0; step < settings.weight_diffusion; ++step) {
    weights = Diffused(weights, model.rest.triangles);
  }
  model.weights = Sparsified(weights);
  return model;
}

RefinementSettings DefaultTemplateRefinement(BodySource source) {
  RefinementSettings settings;
  if (source == BodySource::kMannequin) settings.subdivisions = 2;
  return settings;
}

}  // namespace vitruvia
