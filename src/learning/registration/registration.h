// Registration: fits the body of a shape space to a surface of unknown pose, size and heading.
//
// Start hypotheses (headings × poses of body/start_poses.h) are fitted coarse to fine
// (fitting/pose_search.h); pose, position, the space's first coefficients and one uniform scale are
// estimated together. A known height is held: only shapes of that height are fitted. The result has
// a margin of confidence; a surface that is not a person is rejected with the distances.
#pragma once

#include <memory>
#include <string>

#include "config/settings.h"
#include "fitting/pose_search.h"
#include "fitting/search_settings.h"
#include "fitting/surface_target.h"
#include "geometry/camera.h"
#include "geometry/image.h"
#include "learning/shape/sized_body.h"

namespace vitruvia {

struct RegistrationSettings {
  int components = 10;
  double scale_deviation = 0.15;
  Clothing clothing = Clothing::kLoose;
  PoseSearchSettings search{.headings = 8,
                            .coarse_vertices = 500,
                            .fine_vertices = 2000,
                            .near_m = 0.05,
                            .far_m = 0.15,
                            .least_explained = 0.85};
  int surface_points = 12000;
  double most_distance_m = 0.04;

  void Describe(Fields& fields);
};

struct Registration {
  BodyState state;          // of the registrar's body, in the surface's frame
  MutualDistance distance;  // of the fine body
  double margin = 0.0;      // see SearchOutcome
  std::string start;        // the hypothesis that won
  std::string problem;      // "" for a person; otherwise why the surface is rejected, with numbers
};

class Registrar {
 public:
  // ConfigError if the space has fewer components than the settings ask for.
  Registrar(const ShapeSpace& space, const KnownAttributes& known,
            const RegistrationSettings& settings);
  ~Registrar();

  // Meshes need not be closed nor of one piece; y is up, metres. Vertices in the mesh's frame.
  Registration Find(const TriangleMesh& surface);
  // In the camera frame: y down. The frame must show the person alone.
  Registration Find(const DepthImage& depth, const PinholeCamera& camera);
  // The same person in one or more frames: each frame is registered separately, then one shape is
  // fitted to all of them.
  std::vector<Registration> FindSame(const std::vector<DepthImage>& frames,
                                     const PinholeCamera& camera);
  // Tracks the next surface of a sequence from a nearby state; the shape is kept.
  Registration Follow(const TriangleMesh& surface, const BodyState& near);

  // The body of a shape in its rest pose, subject frame, on the space's own mesh.
  BodyModel Body(const Eigen::VectorXd& theta) const;
  // The motions of that body's bones, from the subject frame to the surface's.
  BoneTransforms SurfaceFromSubject(const BodyState& state) const;

 private:
  FitPriors Priors() const;
  NearFar Limits() const;
  std::vector<PoseHypothesis> Hypotheses(const Matrix3<double>& world_from_front,
                                         double height_m) const;
  // `limits`: those with which its distance was measured.
  Registration Judged(const SearchOutcome& found, const NearFar& limits) const;
  // The expected shape, scaled, in the space's coefficients and the scale's.
  Eigen::VectorXd ScaledShape(double scale) const;
  Eigen::VectorXd ExpectedShape() const;  // in those of body_
  Eigen::VectorXd StartShape(const PoseHypothesis& hypothesis, double height_m) const;
  void Judge(Registration& registration, const NearFar& limits) const;

  const ShapeSpace& space_;
  RegistrationSettings settings_;
  KnownAttributes known_;
  SizedShape expected_;  // of the known attributes
  // The space's coefficients and the scale's; with a known height, those of AsTallAs().
  ShapedBody body_;
  ShapedBody fine_body_, coarse_body_;  // on fewer vertices
  std::unique_ptr<PoseFit> fine_, coarse_;
};

}  // namespace vitruvia
