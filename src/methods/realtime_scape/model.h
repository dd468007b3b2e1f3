// The subject's model in Realtime SCAPE, and its surface in a pose.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "math/rigid.h"
#include "methods/realtime_scape/body_pose.h"

namespace vitruvia::realtime_scape {

// One bone's weight in a vertex.
struct Influence {
  int bone;
  float weight;
};

struct Model {
  explicit Model(const BodyModel& subject);

  std::span<const Influence> InfluencesOf(int vertex) const {
    return {influences.data() + first_influence[vertex],
            influences.data() + first_influence[vertex + 1]};
  }

  // The bone with the largest weight.
  int MainBone(int vertex) const { return weights.bones[vertex][0]; }

  std::vector<Vector3f> rest_vertices, rest_normals;  // V, subject frame
  std::vector<Triangle> triangles;
  SkinWeights weights;
  std::vector<Influence> influences;  // of all vertices, one after the other
  std::vector<int> first_influence;   // V + 1
  std::array<std::vector<int>, kBoneCount> vertices_of_bone;  // by main bone, ascending
  Skeleton skeleton;
  std::array<Vector3<double>, kBoneCount> rest_centers;  // subject frame
};

// The pose of a body that stands in the rest pose.
BodyPose RestPose(const Model& model, const Rigidd& camera_from_subject);

BoneTransforms ToTransforms(const Model& model, const BodyPose& pose);
void ToTransforms(const Model& model, const BodyPose& pose, BoneTransforms& camera_from_rest);
BodyPose ToPose(const Model& model, const BoneTransforms& camera_from_rest);

// The surface in some pose (camera frame).
struct PosedSurface {
  std::vector<Vector3f> vertices;
  BoneTransforms camera_from_rest;
};
void PoseSurface(const Model& model, const BodyPose& pose, PosedSurface& surface);

}  // namespace vitruvia::realtime_scape
