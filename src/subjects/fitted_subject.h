// A subject that was not handed over: scanned, and fitted within the space of shapes (paper A,
// secs. 4 and 5). All that is known of the person are height, weight and sex.
#pragma once

#include <filesystem>

#include "learning/shape/intrinsic_shape.h"
#include "subjects/learned_model.h"
#include "subjects/scan.h"

namespace vitruvia {

// A file of configs/subjects.
struct SubjectRecipe {
  LearningSettings learning;
  ScanSettings scan;  // its person is the scene's that the recipe is used for
  IntrinsicShapeSettings fit;
};

// The file names a learning file and a scan file and holds the settings of the fit.
SubjectRecipe ReadSubjectRecipe(const std::filesystem::path& file);
// Walks over the fields of such a file.
void VisitSubjectFile(Fields& fields);
Json ResolvedRecipe(const SubjectRecipe& recipe);

// The person of a scan: eq. 6, then placed in the subject frame on the tracking mesh, with
// regressed joints and learnt weights.
struct FittedSubject {
  BodyModel body;
  IntrinsicShape fit;
};
FittedSubject FitSubject(const LearnedModel& model, const TriangleMesh& scan,
                         const BodyAttributes& attributes, const IntrinsicShapeSettings& settings);

// A body folder (body/body_model.h) with the scan, scan.ply, and provenance.json beside it.
void WriteFittedSubject(const std::filesystem::path& folder, const FittedSubject& subject,
                        const TriangleMesh& scan, const Json& provenance);

// The subject of that recipe for the scene's person below `cache`, made unless it is there already.
BodyModel ObtainFittedSubject(SubjectRecipe recipe, const SceneSettings& scene,
                              const std::filesystem::path& cache);

}  // namespace vitruvia
