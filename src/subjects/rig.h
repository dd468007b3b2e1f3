// Rigs a person's mesh, or a sequence of meshes: a subject that moves as the meshes do, made of
// nothing but them and a shape space (learning/registration).
#pragma once

#include <optional>
#include <vector>

#include "config/json_settings.h"
#include "learning/registration/registration.h"
#include "learning/skinning/settings.h"
#include "subjects/registration_log.h"

namespace vitruvia {

// Which surface becomes the subject's.
enum class RigSurface {
  kMesh,   // the meshes' own: closed, and the same triangles in all frames
  kModel,  // that of the registered body: for meshes with holes, in pieces, or of changing
           // triangles
};

struct RigSettings {
  RigSurface surface = RigSurface::kMesh;
  RegistrationSettings registration;
  skinning::Settings weights;  // of a sequence
  int smoothing_steps = 10;
  int learning_frames = 60;
  double joint_slack_m = 0.005;
  double rest_stiffness = 3.0;

  void Describe(Fields& fields);
};

// What the T-pose cost.
struct RigCost {
  double reposing_mean_m = 0.0, reposing_max_m = 0.0;  // of the mesh put back into its own pose
  double volume_change = 0.0;                          // of the T-pose against the mesh, a share
  int folded_triangles = 0;                            // turned inside out in the T-pose
};

struct Rig {
  BodyModel subject;                         // the mesh in the T-pose
  std::vector<Registration> registrations;   // one for each frame
  BodyModel model;                           // the body that was registered, in the T-pose
  std::vector<BoneTransforms> model_frames;  // frame_from_model
  std::vector<BoneTransforms> frames;        // frame_from_subject
  int reference = 0;  // the frame with the best registration: weights are carried over in it
  // Of surface kMesh only:
  std::vector<double> rmse_m;   // of each frame: the skinned subject against the frame's mesh
  std::optional<RigCost> cost;  // of the reference frame
};

// One mesh, or one for each frame, in any pose; y up, metres. Of surface kMesh the weights are
// carried over from the registered body and smoothed, and the T-pose follows by inverse skinning;
// of several frames weights and bone transforms are then learnt from them (paper A, eqs. 2–5), and
// the T-pose is that which they all agree on best. DataError naming the frame if one is no person,
// is not closed, or has other triangles than the first. Frames whose registration the log has are
// not registered again; the others' are added to it.
Rig RigMeshes(const std::vector<TriangleMesh>& frames, Registrar& registrar,
              const RigSettings& settings, RegistrationLog& log);

Json RigRecord(const Rig& rig, const RigSettings& settings);

}  // namespace vitruvia
