// What Realtime SCAPE keeps of a subject, and the pose it estimates.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "math/rigid.h"

namespace vitruvia::realtime_scape {

// One bone's share in a vertex.
struct Influence {
  int bone;
  float weight;
};

// Each bone's rotation is about its own centre (the weighted mean of its vertices), not about the
// subject's origin on the floor: the same energy, but a rotation step no longer swings a head by
// metres, so the step sizes of the stopping rule mean what they say and the equations are better
// conditioned.
struct BonePose {
  Matrix3<double> rotation = Matrix3<double>::Identity();  // camera_from_rest
  Vector3<double> center = Vector3<double>::Zero();        // camera frame, metres
};
using BodyPose = std::array<BonePose, kBoneCount>;

struct Model {
  explicit Model(const BodyModel& subject);

  std::span<const Influence> InfluencesOf(int vertex) const {
    return {influences.data() + first_influence[vertex],
            influences.data() + first_influence[vertex + 1]};
  }

  std::vector<Vector3f> rest_vertices, rest_normals;  // V, subject frame
  std::vector<Triangle> triangles;
  SkinWeights weights;
  std::vector<Influence> influences;  // of all vertices, one after the other
  std::vector<int> first_influence;   // V + 1
  Skeleton skeleton;
  std::array<Vector3<double>, kBoneCount> rest_centers;  // subject frame
};

BoneTransforms ToTransforms(const Model& model, const BodyPose& pose);

// The surface in some pose (camera frame).
struct PosedSurface {
  std::vector<Vector3f> vertices;
  BoneTransforms camera_from_rest;
};
void PoseSurface(const Model& model, const BodyPose& pose, PosedSurface& surface);

}  // namespace vitruvia::realtime_scape
