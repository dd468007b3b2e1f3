#include "subjects/rig.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "geometry/surface_map.h"
#include "learning/shape/tracking_template.h"
#include "learning/skinning/decomposition.h"
#include "math/evenly_spread.h"
#include "math/rigid.h"
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
Eigen::MatrixXf NearestWeights(const TriangleMesh& mesh, const BodyModel& model,
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

// Inverse skinning: for each vertex the rest place that its skinned motion carries to its place.
Vertices InverselySkinned(const Vertices& posed, const SkinWeights& weights,
                          const BoneTransforms& posed_from_rest) {
  Vertices rest(posed.size());
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const AffineMotion motion = Blend(weights, v, posed_from_rest);
    const Matrix3<double> turn = motion.leftCols<3>();
    rest[v] = turn.partialPivLu().solve(posed[v].cast<double>() - motion.col(3)).cast<float>();
  }
  return rest;
}

// The rest places that the skinned motions carry nearest to the places in all frames, on average
// over the frames, and whose differences from `prior` vary little along the surface: `stiffness`
// weighs the squared change of that difference along an edge against a squared distance.
Vertices AgreedRest(const std::vector<Vertices>& frames, const std::vector<Triangle>& triangles,
                    const SkinWeights& weights, const std::vector<BoneTransforms>& frame_from_rest,
                    const Vertices& prior, double stiffness) {
  const auto size = static_cast<Eigen::Index>(3 * prior.size());
  const double share = 1.0 / static_cast<double>(frames.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right(size);
  for (std::size_t v = 0; v < prior.size(); ++v) {
    Matrix3<double> normal = Matrix3<double>::Zero();
    Vector3d pull = Vector3d::Zero();
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const AffineMotion motion = Blend(weights, v, frame_from_rest[f]);
      const Matrix3<double> turn = motion.leftCols<3>();
      normal += share * turn.transpose() * turn;
      pull += share * turn.transpose() *
              (frames[f][v].cast<double>() - motion.col(3) - turn * prior[v].cast<double>());
    }
    const auto at = static_cast<int>(3 * v);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) entries.emplace_back(at + i, at + j, normal(i, j));
    }
    right.segment<3>(at) = pull;
  }
  for (const Triangle& t : triangles) {  // each edge once from either side
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) {
        entries.emplace_back(3 * t[k] + i, 3 * t[k] + i, stiffness);
        entries.emplace_back(3 * t[k] + i, 3 * t[(k + 1) % 3] + i, -0.5 * stiffness);
        entries.emplace_back(3 * t[(k + 1) % 3] + i, 3 * t[k] + i, -0.5 * stiffness);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd moved =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  Vertices rest = prior;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    rest[v] += moved.segment<3>(static_cast<Eigen::Index>(3 * v)).cast<float>();
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

// Places each joint where the motions of its two bones agree best over all frames, with a prior on
// the model's position.
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

void RequireOneClosedSurface(const std::vector<TriangleMesh>& frames) {
  constexpr const char* kElsewise = "; the setting \"surface\": \"model\" takes meshes of any kind";
  const MeshReport report = InspectMesh(frames.front());
  if (!report.problem.empty()) {
    throw DataError(
        fmt::format("rig: frame 0: a subject of the meshes needs one closed surface of one whole "
                    "person: {}{}",
                    report.problem, kElsewise));
  }
  for (std::size_t f = 1; f < frames.size(); ++f) {
    if (frames[f].triangles == frames.front().triangles &&
        frames[f].vertices.size() == frames.front().vertices.size()) {
      continue;
    }
    throw DataError(
        fmt::format("rig: frame {}: expected the {} vertices and the triangles of "
                    "frame 0, got {} vertices or other triangles{}",
                    f, frames.front().vertices.size(), frames[f].vertices.size(), kElsewise));
  }
}

BodyModel Subject(const TriangleMesh& rest, SkinWeights weights, const BodyModel& model) {
  BodyModel subject = model;
  subject.name = "rigged";
  subject.rest = rest;
  subject.weights = std::move(weights);
  return subject;
}

// Registers the body in every frame: the first frame by a search, the others starting from the
// frame before.
Rig Registered(const std::vector<TriangleMesh>& frames, Registrar& registrar,
               RegistrationLog& log) {
  Rig rig;
  Progress progress("register", static_cast<int>(frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (f == log.registrations().size()) {
      const Registration next = f == 0
                                    ? registrar.Find(frames[f])
                                    : registrar.Follow(frames[f], log.registrations().back().state);
      if (!next.problem.empty()) {
        log.Remove();
        throw DataError(fmt::format("rig: frame {}: {}", f, next.problem));
      }
      log.Append(next);
    }
    rig.registrations.push_back(log.registrations()[f]);
    const Registration& registration = rig.registrations.back();
    if (registration.distance.mean_m() <
        rig.registrations[static_cast<std::size_t>(rig.reference)].distance.mean_m()) {
      rig.reference = static_cast<int>(f);
    }
    rig.model_frames.push_back(registrar.SurfaceFromSubject(registration.state));
    progress.Advance();
  }
  rig.model = registrar.Body(rig.registrations.front().state.theta);
  rig.frames = rig.model_frames;
  return rig;
}

std::vector<Vertices> FramesToLearnFrom(const std::vector<Vertices>& frames, int most) {
  std::vector<Vertices> chosen;
  for (const int i : EvenlySpread(static_cast<int>(frames.size()), most))
    chosen.push_back(frames[static_cast<std::size_t>(i)]);
  return chosen;
}

// Weights from the registered body in the reference frame, and the T-pose by inverse skinning.
void RigFromReference(const std::vector<Vertices>& frames, const std::vector<Triangle>& triangles,
                      const RigSettings& settings, Rig& rig) {
  const auto reference = static_cast<std::size_t>(rig.reference);
  const TriangleMesh mesh{frames[reference], triangles};
  SkinWeights weights = Smoothed(NearestWeights(mesh, rig.model, rig.model_frames[reference]), mesh,
                                 settings.smoothing_steps);
  const Vertices rest = InverselySkinned(mesh.vertices, weights, rig.model_frames[reference]);
  rig.subject = Subject({rest, triangles}, std::move(weights), rig.model);
}

// Weights, bone transforms, T-pose and joints from all frames.
void LearnFromFrames(const std::vector<Vertices>& frames, const std::vector<Triangle>& triangles,
                     const RigSettings& settings, Rig& rig) {
  BodyModel& subject = rig.subject;
  const skinning::Labels labels = skinning::HeaviestBones(subject.weights);
  subject.weights =
      skinning::Decompose(
          {subject.rest.vertices, FramesToLearnFrom(frames, settings.learning_frames)}, labels,
          skinning::CandidateBones(labels, triangles, kBoneCount, settings.weights),
          settings.weights)
          .weights;
  const auto fit_transforms = [&] {
    return skinning::FitTransforms({subject.rest.vertices, frames}, subject.weights, kBoneCount,
                                   settings.weights.threads)
        .poses;
  };
  rig.frames = fit_transforms();
  subject.rest.vertices = AgreedRest(frames, triangles, subject.weights, rig.frames,
                                     subject.rest.vertices, settings.rest_stiffness);
  rig.frames = fit_transforms();
  MoveJoints(rig.frames, settings.joint_slack_m, subject.skeleton);
}

}  // namespace

void RigSettings::Describe(Fields& f) {
  f.Choice("surface", surface, {{"mesh", RigSurface::kMesh}, {"model", RigSurface::kModel}},
           {.meaning = "source of the subject's surface: mesh: the input meshes, which are closed "
                       "and have the same triangles; model: the registered body"});
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
  f.Number(
      "rest_stiffness", rest_stiffness,
      {.meaning = "how stiffly the T-pose that all frames agree on best holds on to the one of "
                  "inverse skinning: weight of a squared change along an edge against a squared "
                  "distance from a frame's mesh",
       .min = 0.0,
       .max = 1e6,
       .origin = Origin::kGuessed});
  f.Number("joint_slack_m", joint_slack_m,
           {.meaning = "standard deviation of a joint, as the frames' motions place it, from where "
                       "the registered body has it",
            .unit = "m",
            .min = 1e-6,
            .max = 1.0,
            .origin = Origin::kTuned,
            .source = "on a captured man: at 0.02 joints between bones that hardly move against "
                      "each other wander by 7 cm, and Realtime SCAPE loses him in 69 of 175 "
                      "frames; at 0.005 in 8"});
}

Rig RigMeshes(const std::vector<TriangleMesh>& frames, Registrar& registrar,
              const RigSettings& settings, RegistrationLog& log) {
  Require(!frames.empty(), "RigMeshes: no frames");
  if (settings.surface == RigSurface::kMesh) RequireOneClosedSurface(frames);
  Rig rig = Registered(frames, registrar, log);
  if (settings.surface == RigSurface::kModel) {
    rig.subject = OnTrackingMesh(rig.model, MakeTrackingTemplate(rig.model.rest));
    rig.subject.name = "rigged";
    return rig;
  }
  const std::vector<Triangle>& triangles = frames.front().triangles;
  std::vector<Vertices> places;
  for (const TriangleMesh& frame : frames) places.push_back(frame.vertices);
  RigFromReference(places, triangles, settings, rig);
  if (frames.size() > 1) LearnFromFrames(places, triangles, settings, rig);
  StandOnFloor(rig.subject, rig.frames);
  const auto reference = static_cast<std::size_t>(rig.reference);
  rig.rmse_m = FrameErrors(places, rig.subject, rig.frames);
  rig.cost = CostOf(frames[reference], rig.subject, rig.frames[reference]);
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
                      {"body_explained", r.distance.body_explained}});
    if (!rig.rmse_m.empty()) frames.back()["rmse_m"] = rig.rmse_m[f];
  }
  Json record = {{"made_by", "vitruvia rig"},
                 {"settings", WriteSettings(settings)},
                 {"reference_frame", rig.reference},
                 {"frames", frames},
                 {"build", Provenance()}};
  const double margin = rig.registrations.front().margin;
  if (std::isfinite(margin)) record["margin"] = margin;
  if (rig.cost) {
    record["cost"] = {{"reposing_mean_m", rig.cost->reposing_mean_m},
                      {"reposing_max_m", rig.cost->reposing_max_m},
                      {"volume_change", rig.cost->volume_change},
                      {"folded_triangles", rig.cost->folded_triangles}};
  }
  return record;
}

}  // namespace vitruvia
