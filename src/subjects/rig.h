// Rigs a person's mesh, or a sequence of meshes: a subject that moves as the meshes do, made of
// nothing but them and a shape space (learning/registration).
#pragma once

#include <functional>
#include <vector>

#include "config/json_settings.h"
#include "learning/registration/registration.h"
#include "learning/skinning/settings.h"

namespace vitruvia {

struct RigSettings {
  RegistrationSettings registration;
  skinning::Settings weights;  // of a sequence
  int smoothing_steps = 10;
  int learning_frames = 60;
  double joint_slack_m = 0.02;

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
  std::vector<double> rmse_m;  // of each frame: the skinned subject against the frame's mesh
  int reference = 0;           // the frame that weights were carried over in
  RigCost cost;                // of the reference frame
};

// One mesh in any pose. DataError if it is no closed surface, or no person.
Rig RigMesh(const TriangleMesh& mesh, Registrar& registrar, const RigSettings& settings);

// Meshes of the same triangles: weights and bone transforms are learnt from the frames (paper A,
// eqs. 2–5), the T-pose follows from all of them by least squares. DataError naming the frame if
// one is no person.
Rig RigSequence(const std::vector<Triangle>& triangles,
                const std::vector<std::vector<Vector3f>>& frames, Registrar& registrar,
                const RigSettings& settings);

Json RigRecord(const Rig& rig, const RigSettings& settings);

}  // namespace vitruvia
