#include "methods/realtime_scape/model.h"

#include "math/rigid.h"

namespace vitruvia::realtime_scape {

Model::Model(const BodyModel& subject)
    : rest_vertices(subject.rest.vertices),
      triangles(subject.rest.triangles),
      weights(subject.weights),
      skeleton(subject.skeleton) {
  ComputeVertexNormals(rest_vertices, triangles, rest_normals);

  std::array<double, kBoneCount> mass{};
  rest_centers.fill(Vector3<double>::Zero());
  first_influence.push_back(0);
  for (std::size_t i = 0; i < rest_vertices.size(); ++i) {
    for (int k = 0; k < kMaxInfluences; ++k) {
      const float weight = weights.weights[i][k];
      if (weight <= 0.0f) continue;
      const int bone = weights.bones[i][k];
      influences.push_back({bone, weight});
      mass[bone] += weight;
      rest_centers[bone] += weight * rest_vertices[i].cast<double>();
    }
    first_influence.push_back(static_cast<int>(influences.size()));
    vertices_of_bone[MainBone(static_cast<int>(i))].push_back(static_cast<int>(i));
  }
  // A bone without vertices rotates about its joint.
  for (int j = 0; j < kBoneCount; ++j) {
    rest_centers[j] =
        mass[j] > 0.0 ? Vector3<double>(rest_centers[j] / mass[j]) : skeleton.joints[j];
  }
}

BodyPose RestPose(const Model& model, const Rigidd& camera_from_subject) {
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j] = {camera_from_subject.rotation, camera_from_subject * model.rest_centers[j]};
  }
  return pose;
}

BoneTransforms ToTransforms(const Model& model, const BodyPose& pose) {
  BoneTransforms camera_from_rest;
  ToTransforms(model, pose, camera_from_rest);
  return camera_from_rest;
}

void ToTransforms(const Model& model, const BodyPose& pose, BoneTransforms& camera_from_rest) {
  camera_from_rest.resize(kBoneCount);
  for (int j = 0; j < kBoneCount; ++j) {
    camera_from_rest[j] = {pose[j].rotation,
                           pose[j].center - pose[j].rotation * model.rest_centers[j]};
  }
}

BodyPose ToPose(const Model& model, const BoneTransforms& camera_from_rest) {
  BodyPose pose;
  for (int j = 0; j < kBoneCount; ++j) {
    pose[j] = {camera_from_rest[j].rotation, camera_from_rest[j] * model.rest_centers[j]};
  }
  return pose;
}

void PoseSurface(const Model& model, const BodyPose& pose, PosedSurface& surface) {
  ToTransforms(model, pose, surface.camera_from_rest);
  SkinLinear(model.rest_vertices, model.weights, surface.camera_from_rest, surface.vertices);
}

}  // namespace vitruvia::realtime_scape
