// Surfaces of many control bodies of one topology, whose subdivision is computed once.
#pragma once

#include <vector>

#include "body/subdivision.h"
#include "synth/bodies/body_source.h"

namespace vitruvia {

class Refiner {
 public:
  Refiner(const QuadMesh& cage, const RefinementSettings& settings);

  // The body must have the cage's quads.
  BodyModel Refined(const ControlBody& body) const;
  // Refined(body).rest.vertices, without the weights where no decimation needs them.
  std::vector<Vector3f> Vertices(const ControlBody& body) const;

 private:
  void RequireFits(const ControlBody& body) const;
  const std::vector<Quad>& FinestQuads() const;
  Eigen::MatrixXf Subdivided(Eigen::MatrixXf values) const;

  RefinementSettings settings_;
  std::vector<Quad> quads_;
  std::vector<SubdivisionStep> steps_;
};

}  // namespace vitruvia
