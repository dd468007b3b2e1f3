// Rigs a person's mesh, or a sequence of meshes: builds an animatable subject from the meshes and a
// shape space alone (learning/registration).
#pragma once

#include <optional>
#include <vector>

#include "config/json_settings.h"
#include "learning/registration/registration.h"
#include "learning/skinning/settings.h"
#include "subjects/registration_log.h"

namespace vitruvia {

// The source of the subject's surface.
enum class RigSurface {
  kMesh,   // the input meshes, which must be closed and have the same triangles in all frames
  kModel,  // the registered body: for meshes with holes, several components, or changing triangles
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

// Distortion caused by the transfer to the T-pose.
struct RigCost {
  double reposing_mean_m = 0.0, reposing_max_m = 0.0;  // error of the subject posed like the mesh
                                                       // again
  double volume_change = 0.0;                          // relative change from the mesh to the
                                                       // T-pose
  int folded_triangles = 0;                            // triangles that are inverted in the T-pose
};

struct Rig {
  BodyModel subject;                         // the mesh in the T-pose
  std::vector<Registration> registrations;   // one for each frame
  BodyModel model;                           // the body that was registered, in the T-pose
  std::vector<BoneTransforms> model_frames;  // frame_from_model
  std::vector<BoneTransforms> frames;        // frame_from_subject
  int reference = 0;  // the frame with the best registration, in which weights are transferred
  // Only with kMesh:
  std::vector<double> rmse_m;   // of each frame: the skinned subject against the frame's mesh
  std::optional<RigCost> cost;  // of the reference frame
};

// `frames`: one mesh, or one for each frame, in any pose; y up, metres. With kMesh the weights are
// transferred from the registered body and smoothed, and the T-pose follows by inverse skinning;
// with several frames, weights and bone transforms are then learnt from them (paper A, eqs. 2–5),
// and the T-pose is the one that fits all frames best. DataError naming the frame if a mesh is not
// a person, is not closed, or has different triangles from the first. Frames whose registration is
// in the log are not registered again; the registrations of the others are added to it.
Rig RigMeshes(const std::vector<TriangleMesh>& frames, Registrar& registrar,
              const RigSettings& settings, RegistrationLog& log);

Json RigRecord(const Rig& rig, const RigSettings& settings);

}  // namespace vitruvia
