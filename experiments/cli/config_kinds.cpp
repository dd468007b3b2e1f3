#include "experiments/cli/config_kinds.h"

#include "analysis/gate_reports.h"
#include "analysis/reproduction_list.h"
#include "config/did_you_mean.h"
#include "config/stored_data.h"
#include "core/error.h"
#include "experiments/cli/regress_config.h"
#include "experiments/plan/run_plan.h"
#include "experiments/studies/model_study.h"
#include "experiments/studies/shape_study.h"
#include "experiments/studies/weight_study.h"
#include "importers/depth_import.h"
#include "importers/eval_import.h"
#include "importers/mesh_import.h"
#include "records/estimate.h"
#include "subjects/fitted_subject.h"
#include "subjects/learned_joints.h"
#include "subjects/learned_regression.h"
#include "subjects/rig.h"
#include "subjects/scan.h"
#include "subjects/seen_subject.h"
#include "synth/motions/keyframes_file.h"
#include "synth/sensor/joint_stand_in.h"
#include "tracking/joint_observations.h"

namespace vitruvia {
namespace {

// A kind of file that the program writes and reads again (docs/stored_data.md).
template <class Struct>
ConfigKind StoredKind(const std::string& name, const std::string& meaning) {
  return {name, meaning, VisitDefaults<Struct>, StoredSchema<Struct>, FileKind::kStoredData};
}

}  // namespace

const std::vector<ConfigKind>& ConfigKinds() {
  static const std::vector<ConfigKind> kinds = [] {
    std::vector<ConfigKind> list = {
        {"experiment", "runs of trackers on scenes", VisitDefaults<ExperimentSettings>, nullptr},
        {"intrinsic_shape", "an experiment of that kind: shapes fitted to scans",
         VisitDefaults<ShapeStudySettings>, nullptr},
        {"skinning_weights", "an experiment of that kind: weights used on other people",
         VisitDefaults<WeightStudySettings>, nullptr},
        {"model_drawing", "an experiment of that kind: drawings of a tracker's model",
         VisitDefaults<ModelStudySettings>, nullptr},
        {"reproduction", "the list of the papers' figures that `vitruvia reproduce` makes",
         VisitDefaults<ReproductionList>, nullptr},
        {"regression", "what the regression gate measures", VisitDefaults<RegressSettings>,
         nullptr},
        {"scene", "a body, its motion and a camera", VisitDefaults<SceneSettings>, nullptr,
         FileKind::kSettings, "scene"},
        {"method", "a tracking method and its settings", VisitMethodFile, MethodFileSchema},
        {"scan", "a camera that moves round a person", VisitDefaults<ScanSettings>, nullptr},
        {"learning", "what is learnt from a population", VisitDefaults<LearningSettings>, nullptr},
        {"joint_learning", "how a joint detector is learnt", VisitDefaults<JointLearningSettings>,
         nullptr},
        {"pose_regression", "how deformations by the pose are learnt",
         VisitDefaults<RegressionLearningSettings>, nullptr},
        {"joint_stand_in", "noise of a stand-in for a joint detector",
         VisitDefaults<JointStandInSettings>, nullptr},
        {"fit", "how a shape is fitted to a scan", VisitDefaults<IntrinsicShapeSettings>, nullptr},
        {"subject", "a subject that is scanned and fitted", VisitSubjectFile, nullptr},
        {"rig", "how meshes are made a subject", VisitDefaults<RigSettings>, nullptr},
        {"seen_subject", "how depth frames are made a subject", VisitDefaults<SeenSubjectSettings>,
         nullptr},
        {"skeleton", "a kinematic skeleton", VisitSkeletonFile, nullptr},
        {"import_meshes", "mesh files made into a sequence", VisitDefaults<MeshSequenceSettings>,
         nullptr},
        {"import_depth", "a recording of a depth camera made into a sequence",
         VisitDefaults<DepthImportSettings>, nullptr},
        {"import_eval", "Stanford EVAL files made into a sequence",
         VisitDefaults<EvalImportSettings>, nullptr},
        {"motion", "key frames of a motion", VisitMotionFile, nullptr},
        StoredKind<RunRecord>("record", "record.json: all that reports show of a run"),
        StoredKind<EstimateFile>("estimate", "estimate.json: what a tracker said of each frame"),
        StoredKind<ExperimentSummary>("summary", "summary.json: an experiment's numbers"),
        StoredKind<ExperimentRecord>("experiment_record", "experiment.json in an output folder"),
        StoredKind<GateBaseline>("baseline", "baseline of the regression gate"),
        StoredKind<JointObservations>("joint_observations",
                                      "joints found in each frame of a sequence"),
        StoredKind<RegressionFile>("regression_report", "regression.json: the gate's findings")};
    for (const MethodInfo& method : Methods()) {
      list.push_back({method.name, "settings of the method " + method.name, method.visit_settings,
                      nullptr, FileKind::kSettings, "method.settings"});
    }
    return list;
  }();
  return kinds;
}

const ConfigKind& FindConfigKind(const std::string& name) {
  std::vector<std::string> names;
  for (const ConfigKind& kind : ConfigKinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw ConfigError(fmt::format("schema: no kind of file \"{}\";{} there are: {}", name,
                                DidYouMean(name, names, " "), fmt::join(names, ", ")));
}

Json SchemaOf(const ConfigKind& kind) {
  return ConfigSchema("vitruvia: " + kind.meaning,
                      kind.schema != nullptr ? kind.schema() : SettingsSchema(kind.visit));
}

}  // namespace vitruvia
