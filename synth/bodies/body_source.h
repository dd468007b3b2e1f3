// Bodies for ground truth and templates: the embedded mannequin and imported MakeHuman bodies.
#pragma once

#include <filesystem>

#include "body/body_model.h"
#include "config/settings.h"
#include "geometry/mesh.h"

namespace vitruvia {

enum class BodySource { kMannequin, kMakeHuman };

// Which person. The same settings give the same body; any two bodies of a source share one
// topology.
struct BodySettings {
  BodySource source = BodySource::kMannequin;
  Sex sex = Sex::kMale;
  double height_m = 1.75;
  double weight_kg = 72.0;
  double age_years = 25.0;  // makehuman only
  double muscle = 0.5;      // makehuman only, 0 … 1
  std::filesystem::path
      makehuman_folder;  // makehuman only: the npm package or a MakeHuman data folder

  void Describe(Fields& fields);
  std::string Problem() const;  // unattainable combinations of height and weight
};

// The body that a source generates: quads in the T-pose (subject frame, metres, feet on y = 0,
// facing +z) and one weight per vertex and bone.
struct ControlBody {
  std::string name;
  QuadMesh cage;
  Eigen::MatrixXf weights;  // V × kBoneCount, ≥ 0, rows sum to 1; at most 4 non-zero
  Skeleton skeleton;
  BodyAttributes attributes;
  // The cage's vertices on the source's reference body, which is decimated so that all subjects
  // keep the same vertices; empty: each subject is decimated separately.
  std::vector<Vector3f> reference_vertices;
};

// DataError if a source's files are missing or damaged; the mannequin needs none.
ControlBody MakeControlBody(const BodySettings& settings);

// Settings for making a surface from a control body.
struct RefinementSettings {
  int subdivisions = 0;      // Catmull–Clark steps, of positions and weights alike
  int weight_diffusion = 0;  // steps of averaging each vertex's weights with its neighbours'
  int target_vertices = 0;   // final decimation to this number of vertices; 0: no decimation

  void Describe(Fields& fields);
  std::string Problem() const;
};
BodyModel Refine(const ControlBody& body, const RefinementSettings& settings);

// The tracking template's detail: about 6,250 vertices and 12,500 triangles (paper A, sec. 6.2).
RefinementSettings DefaultTemplateRefinement(BodySource source);

}  // namespace vitruvia
