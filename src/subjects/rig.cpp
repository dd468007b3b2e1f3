#include "subjects/rig.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "geometry/surface_map.h"
#include "learning/skinning/decomposition.h"
#include "learning/skinning/fit_errors.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

using Vertices = std::vector<Vector3f>;
using AffineMotion = Eigen::Matrix<double, 3, 4>;

AffineMotion Blend(const SkinWeights& weights, std::size_t vertex, const BoneTransforms& bones) {
  AffineMotion blend = AffineMotion::Zero();
  for (int k = 0; k < kMaxInfluences; ++k) {
    const double weight = weights.weights[vertex][k];
    const Rigidd& bone = bones[weights.bones[vertex][k]];
    blend.leftCols<3>() += weight * bone.rotation;
    blend.col(3) += weight * bone.translation;
  }
  return blend;
}

// The model's weights at the points of its posed surface nearest to the mesh's vertices.
Eigen::MatrixXf CarriedOver(const TriangleMesh& mesh, const BodyModel& model,
                            const BoneTransforms& mesh_from_model) {
  TriangleMesh posed = model.rest;
  SkinLinear(model.rest.vertices, model.weights, mesh_from_model, posed.vertices);
  const Eigen::MatrixXf corners = Dense(model.weights, kBoneCount);
  Eigen::MatrixXf weights(static_cast<Eigen::Index>(mesh.vertices.size()), kBoneCount);
  const std::vector<SurfacePoint> nearest = ClosestSurfacePoints(mesh.vertices, posed);
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    const Triangle& t = posed.triangles[static_cast<std::size_t>(nearest[v].triangle)];
    auto row = weights.row(static_cast<Eigen::Index>(v));
    row.setZero();
    for (int k = 0; k < 3; ++k) row += nearest[v].barycentric[k] * corners.row(t[k]);
  }
  return weights;
}

std::vector<std::vector<int>> NeighboursOf(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> neighbours(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[k]].push_back(t[(k + 2) % 3]);
    }
  }
  return neighbours;
}

// Each step averages a vertex's weights with its neighbours'.
SkinWeights Smoothed(Eigen::MatrixXf weights, const TriangleMesh& mesh, int steps) {
  const std::vector<std::vector<int>> neighbours = NeighboursOf(mesh);
  for (int step = 0; step < steps; ++step) {
    Eigen::MatrixXf next = weights;
    for (std::size_t v = 0; v < neighbours.size(); ++v) {
      if (neighbours[v].empty()) continue;
      Eigen::RowVectorXf mean = Eigen::RowVectorXf::Zero(weights.cols());
      for (const int other : neighbours[v]) mean += weights.row(other);
      const auto row = static_cast<Eigen::Index>(v);
      next.row(row) = 0.5f * (weights.row(row) + mean / static_cast<float>(neighbours[v].size()));
    }
    weights = std::move(next);
  }
  return Sparsified(weights);
}

// For each vertex the rest place that its skinned motion carries nearest to its places in all
// frames (least squares); of one frame: inverse skinning.
Vertices RestOf(const std::vector<Vertices>& frames, const SkinWeights& weights,
                const std::vector<BoneTransforms>& frame_from_rest) {
  Vertices rest(weights.size());
  for (std::size_t v = 0; v < rest.size(); ++v) {
    Matrix3<double> normal = Matrix3<double>::Zero();
    Vector3d right = Vector3d::Zero();
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const AffineMotion motion = Blend(weights, v, frame_from_rest[f]);
      normal += motion.leftCols<3>().transpose() * motion.leftCols<3>();
      right += motion.leftCols<3>().transpose() * (frames[f][v].cast<double>() - motion.col(3));
    }
    rest[v] = normal.ldlt().solve(right).cast<float>();
  }
  return rest;
}

std::vector<double> FrameErrors(const std::vector<Vertices>& frames, const BodyModel& subject,
                                const std::vector<BoneTransforms>& frame_from_subject) {
  std::vector<double> rmse_m;
  Vertices posed;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    SkinLinear(subject.rest.vertices, subject.weights, frame_from_subject[f], posed);
    double sum = 0.0;
    for (std::size_t v = 0; v < posed.size(); ++v) {
      sum += (posed[v] - frames[f][v]).cast<double>().squaredNorm();
    }
    rmse_m.push_back(std::sqrt(sum / static_cast<double>(posed.size())));
  }
  return rmse_m;
}

Vector3f TriangleNormal(const Vertices& vertices, const Triangle& t) {
  return (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
}

RigCost CostOf(const TriangleMesh& mesh, const BodyModel& subject,
               const BoneTransforms& mesh_from_subject) {
  Vertices posed;
  SkinLinear(subject.rest.vertices, subject.weights, mesh_from_subject, posed);
  std::vector<double> errors_m;
  for (std::size_t v = 0; v < posed.size(); ++v) {
    errors_m.push_back((posed[v] - mesh.vertices[v]).norm());
  }
  RigCost cost{Mean(errors_m), Maximum(errors_m),
               EnclosedVolume(subject.rest) / EnclosedVolume(mesh) - 1.0, 0};
  for (const Triangle& t : mesh.triangles) {
    const Matrix3<float> turn =
        Blend(subject.weights, static_cast<std::size_t>(t[0]), mesh_from_subject)
            .leftCols<3>()
            .cast<float>();
    const Vector3f turned = turn * TriangleNormal(subject.rest.vertices, t);
    cost.folded_triangles += turned.dot(TriangleNormal(mesh.vertices, t)) < 0.0f;
  }
  return cost;
}

// Each joint where the motions of its two bones agree best over all frames, held near the model's.
void MoveJoints(const std::vector<BoneTransforms>& frame_from_rest, double slack_m,
                Skeleton& skeleton) {
  constexpr double kDisagreement_m = 0.01;  // of two bones' motions at their joint
  const double stiffness = std::pow(kDisagreement_m / slack_m, 2);
  for (int b = 1; b < kBoneCount; ++b) {
    const auto parent = static_cast<std::size_t>(Bones()[b].parent);
    Matrix3<double> normal = stiffness * Matrix3<double>::Identity();
    Vector3d right = Vector3d::Zero();
    const auto count = static_cast<double>(frame_from_rest.size());
    for (const BoneTransforms& bones : frame_from_rest) {
      const Matrix3<double> turn = bones[b].rotation - bones[parent].rotation;
      const Vector3d apart =
          turn * skeleton.joints[b] + bones[b].translation - bones[parent].translation;
      normal += turn.transpose() * turn / count;
      right -= turn.transpose() * apart / count;
    }
    skeleton.joints[b] += normal.ldlt().solve(right);
  }
}

void StandOnFloor(BodyModel& body, std::vector<BoneTransforms>& frame_from_subject) {
  const float lowest = BoundingBox(body.rest.vertices).min().y();
  const Vector3d lift(0.0, -lowest, 0.0);
  for (Vector3f& v : body.rest.vertices) v.y() -= lowest;
  for (int b = 0; b < kBoneCount; ++b) {
    body.skeleton.joints[b] += lift;
    body.skeleton.tips[b] += lift;
  }
  for (BoneTransforms& bones : frame_from_subject) {
    for (Rigidd& bone : bones) bone.translation -= bone.rotation * lift;
  }
}

void RequireClosed(const TriangleMesh& mesh) {
  const MeshReport report = InspectMesh(mesh);
  if (report.problem.empty()) return;
  throw DataError(fmt::format(
      "rig: the mesh must be one closed surface to become a subject's, but {}", report.problem));
}

void RequirePerson(const Registration& registration, std::size_t frame) {
  if (registration.problem.empty()) return;
  throw DataError(fmt::format("rig: frame {}: {}", frame, registration.problem));
}

BodyModel Subject(const TriangleMesh& rest, SkinWeights weights, const BodyModel& model) {
  BodyModel subject = model;
  subject.name = "rigged";
  subject.rest = rest;
  subject.weights = std::move(weights);
  return subject;
}

std::vector<Registration> RegisterAll(const std::vector<Triangle>& triangles,
                                      const std::vector<Vertices>& frames, Registrar& registrar) {
  std::vector<Registration> registrations;
  Progress progress("register", static_cast<int>(frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const TriangleMesh mesh{frames[f], triangles};
    registrations.push_back(f == 0 ? registrar.Find(mesh)
                                   : registrar.Follow(mesh, registrations.back().state));
    RequirePerson(registrations.back(), f);
    progress.Advance();
  }
  return registrations;
}

// Frames from first to last, evenly spaced.
template <class Item>
std::vector<Item> Spread(const std::vector<Item>& all, int most) {
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(most));
  std::vector<Item> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  return chosen;
}

}  // namespace

void RigSettings::Describe(Fields& f) {
  f.Section("registration", registration, {.meaning = "how a body is put onto the meshes"});
  f.Section("weights", weights, {.meaning = "how skinning weights are learnt from a sequence"});
  f.Integer("smoothing_steps", smoothing_steps,
            {.meaning = "steps in which the weights that are carried over to a mesh are averaged "
                        "with those of neighbouring vertices",
             .min = 0,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Integer("learning_frames", learning_frames,
            {.meaning = "frames, evenly spaced, that skinning weights are learnt from",
             .min = 1,
             .max = 100000,
             .origin = Origin::kGuessed,
             .source = "paper A, sec. 4 has 70 poses"});
  f.Number("joint_slack_m", joint_slack_m,
           {.meaning = "standard deviation of a joint, as the frames' motions place it, from where "
                       "the registered body has it",
            .unit = "m",
            .min = 1e-6,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

Rig RigMesh(const TriangleMesh& mesh, Registrar& registrar, const RigSettings& settings) {
  RequireClosed(mesh);
  Rig rig;
  rig.registrations.push_back(registrar.Find(mesh));
  RequirePerson(rig.registrations.front(), 0);
  const BodyState& state = rig.registrations.front().state;
  const BodyModel model = registrar.Body(state.theta);
  rig.frames.push_back(registrar.SurfaceFromSubject(state));
  SkinWeights weights =
      Smoothed(CarriedOver(mesh, model, rig.frames.front()), mesh, settings.smoothing_steps);
  const Vertices rest = RestOf({mesh.vertices}, weights, rig.frames);
  rig.subject = Subject({rest, mesh.triangles}, std::move(weights), rig.model);
  StandOnFloor(rig.subject, rig.frames);
  rig.rmse_m = FrameErrors({mesh.vertices}, rig.subject, rig.frames);
  rig.cost = CostOf(mesh, rig.subject, rig.frames.front());
  return rig;
}

Rig RigSequence(const std::vector<Triangle>& triangles, const std::vector<Vertices>& frames,
                Registrar& registrar, const RigSettings& settings) {
  RequireClosed({frames.front(), triangles});
  Rig rig;
  rig.registrations = RegisterAll(triangles, frames, registrar);
  const auto best = std::min_element(rig.registrations.begin(), rig.registrations.end(),
                                     [](const Registration& a, const Registration& b) {
                                       return a.distance.mean_m() < b.distance.mean_m();
                                     });
  rig.reference = static_cast<int>(best - rig.registrations.begin());
  const auto reference = static_cast<std::size_t>(rig.reference);
  rig.model = registrar.Body(rig.registrations.front().state.theta);
  for (const Registration& r : rig.registrations) {
    rig.model_frames.push_back(registrar.SurfaceFromSubject(r.state));
  }
  rig.frames = rig.model_frames;

  const TriangleMesh reference_mesh{frames[reference], triangles};
  SkinWeights weights = Smoothed(CarriedOver(reference_mesh, rig.model, rig.frames[reference]),
                                 reference_mesh, settings.smoothing_steps);
  Vertices rest = RestOf(frames, weights, rig.frames);
  const skinning::Labels labels = skinning::HeaviestBones(weights);
  const skinning::Decomposition learnt = skinning::Decompose(
      {rest, Spread(frames, settings.learning_frames)}, labels,
      skinning::CandidateBones(labels, triangles, kBoneCount, settings.weights), settings.weights);
  rig.frames =
      skinning::FitTransforms({rest, frames}, learnt.weights, kBoneCount, settings.weights.threads)
          .poses;
  rest = RestOf(frames, learnt.weights, rig.frames);
  rig.frames =
      skinning::FitTransforms({rest, frames}, learnt.weights, kBoneCount, settings.weights.threads)
          .poses;
  rig.subject = Subject({rest, triangles}, learnt.weights, rig.model);
  MoveJoints(rig.frames, settings.joint_slack_m, rig.subject.skeleton);
  StandOnFloor(rig.subject, rig.frames);
  rig.rmse_m = FrameErrors(frames, rig.subject, rig.frames);
  rig.cost = CostOf(reference_mesh, rig.subject, rig.frames[reference]);
  return rig;
}

Json RigRecord(const Rig& rig, const RigSettings& settings) {
  Json frames = Json::array();
  for (std::size_t f = 0; f < rig.registrations.size(); ++f) {
    const Registration& r = rig.registrations[f];
    frames.push_back({{"start", r.start},
                      {"surface_to_body_m", r.distance.target_to_body_m},
                      {"body_to_surface_m", r.distance.body_to_target_m},
                      {"surface_explained", r.distance.target_explained},
                      {"body_explained", r.distance.body_explained},
                      {"rmse_m", rig.rmse_m[f]}});
  }
  return {{"made_by", "vitruvia rig"},
          {"settings", WriteSettings(settings)},
          {"reference_frame", rig.reference},
          {"margin", rig.registrations.front().margin},
          {"cost",
           {{"reposing_mean_m", rig.cost.reposing_mean_m},
            {"reposing_max_m", rig.cost.reposing_max_m},
            {"volume_change", rig.cost.volume_change},
            {"folded_triangles", rig.cost.folded_triangles}}},
          {"frames", frames},
          {"build", Provenance()}};
}

}  // namespace vitruvia
