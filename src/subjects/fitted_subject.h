// A subject that is scanned and fitted in the shape space (paper A, secs. 4 and 5). Only height,
// weight and sex of the person are given.
#pragma once

#include <filesystem>

#include "learning/shape/intrinsic_shape.h"
#include "subjects/learned_model.h"
#include "subjects/scan.h"

namespace vitruvia {

// A file of configs/subjects.
struct SubjectRecipe {
  LearningSettings learning;
  ScanSettings scan;  // its person is that of the scene for which the recipe is used
  IntrinsicShapeSettings fit;
};

// The file names a learning file and a scan file and holds the settings of the fit.
SubjectRecipe ReadSubjectRecipe(const std::filesystem::path& file);
// Walks over the fields of a subject file.
void VisitSubjectFile(Fields& fields);
Json ResolvedRecipe(const SubjectRecipe& recipe);

// The person of a scan: fitted by eq. 6, then transferred to the tracking mesh in the subject
// frame, with regressed joints and learnt weights.
struct FittedSubject {
  BodyModel body;
  IntrinsicShape fit;
};
FittedSubject FitSubject(const LearnedModel& model, const TriangleMesh& scan,
                         const BodyAttributes& attributes, const IntrinsicShapeSettings& settings);

// A body folder (body/body_model.h) with the scan, scan.ply, and provenance.json beside it.
void WriteFittedSubject(const std::filesystem::path& folder, const FittedSubject& subject,
                        const TriangleMesh& scan, const Json& provenance);

// The subject of that recipe for the scene's person, read from `cache` or built there if it is
// missing.
BodyModel ObtainFittedSubject(SubjectRecipe recipe, const SceneSettings& scene,
                              const std::filesystem::path& cache);

}  // namespace vitruvia
