#include "importers/mesh_import.h"

#include <algorithm>
#include <optional>

#include <Eigen/QR>

#include "config/json_settings.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/progress.h"
#include "geometry/mesh_io.h"
#include "geometry/surface_map.h"
#include "geometry/zbuffer.h"
#include "importers/checked_sequence.h"
#include "importers/frame_files.h"
#include "math/rigid.h"
#include "sequence/joint_visibility.h"
#include "sequence/sequence.h"
#include "sequence/view_watch.h"
#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

constexpr float kNearestToCamera_m = 0.1f;

// Finds the subject's joints from the true surface in a pose: the affine motions A_b of the bones
// that come nearest to Σ_b w_vb A_b x_v = y_v over all vertices v of the template (x_v at rest, y_v
// now, w_vb its skinning weights), by linear least squares. Exact for a linearly skinned truth.
class JointFinder {
 public:
  JointFinder(const BodyModel& subject, const TriangleMesh& true_rest)
      : subject_(subject),
        on_truth_(ClosestSurfacePoints(subject.rest.vertices, true_rest)),
        triangles_(true_rest.triangles),
        rows_(Rows(subject)),
        normal_(rows_.transpose() * rows_) {
    if (normal_.rank() < kUnknowns) {
      throw DataError(
          fmt::format("subject: its weights leave the motion of a bone open (rank {} of {}), so "
                      "that the joints "
                      "cannot be found on the meshes",
                      normal_.rank(), kUnknowns));
    }
  }

  std::vector<Vector3d> Find(const std::vector<Vector3f>& true_vertices) const {
    Eigen::MatrixX3d places(rows_.rows(), 3);
    for (std::size_t v = 0; v < on_truth_.size(); ++v) {
      places.row(static_cast<Eigen::Index>(v)) =
          Evaluate(on_truth_[v], true_vertices.data(), triangles_).cast<double>().transpose();
    }
    const Eigen::MatrixX3d motions = normal_.solve(rows_.transpose() * places);
    std::vector<Vector3d> joints;
    for (int b = 0; b < kBoneCount; ++b) {
      const Eigen::RowVector4d rest = subject_.skeleton.joints[b].homogeneous().transpose();
      joints.emplace_back((rest * motions.middleRows<4>(4 * b)).transpose());
    }
    return joints;
  }

 private:
  static constexpr int kUnknowns = 4 * kBoneCount;  // per coordinate

  static Eigen::MatrixXd Rows(const BodyModel& subject) {
    const std::vector<Vector3f>& rest = subject.rest.vertices;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rest.size()), kUnknowns);
    for (std::size_t v = 0; v < rest.size(); ++v) {
      for (std::size_t k = 0; k < subject.weights.weights[v].size(); ++k) {
        const double weight = subject.weights.weights[v][k];
        rows.block<1, 4>(static_cast<Eigen::Index>(v), 4 * subject.weights.bones[v][k]) +=
            weight * rest[v].cast<double>().homogeneous().transpose();
      }
    }
    return rows;
  }

  const BodyModel& subject_;
  std::vector<SurfacePoint> on_truth_;
  std::vector<Triangle> triangles_;
  Eigen::MatrixXd rows_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> normal_;
};

// The mesh of one frame, camera frame.
TriangleMesh ReadFrame(const fs::path& file, const MeshSequenceSettings& settings) {
  TriangleMesh mesh = ReadMesh(file, settings.unit_m);
  if (settings.frame == MeshFrame::kSubject) {
    const Rigidf camera_from_subject = CameraFromSubject(settings.view).Cast<float>();
    for (Vector3f& v : mesh.vertices) v = camera_from_subject * v;
  }
  for (const Vector3f& v : mesh.vertices) {
    if (v.z() >= kNearestToCamera_m) continue;
    throw DataError(
        fmt::format("{}: a vertex is {:.2f} m in front of the camera, expected at least "
                    "{} (is `frame` or `unit_m` right?)",
                    file.string(), v.z(), kNearestToCamera_m));
  }
  return mesh;
}

void RequireSameMesh(const fs::path& file, const TriangleMesh& mesh, const TriangleMesh& rest) {
  if (mesh.vertices.size() != rest.vertices.size() || mesh.triangles != rest.triangles) {
    throw DataError(fmt::format(
        "{}: expected the {} vertices and {} triangles of the rest mesh in their order, got {} and "
        "{}{}",
        file.string(), rest.vertices.size(), rest.triangles.size(), mesh.vertices.size(),
        mesh.triangles.size(),
        mesh.triangles.size() == rest.triangles.size() ? " (other triangles)" : ""));
  }
}

SequenceInfo InfoOf(const MeshSequenceSettings& settings, int frames) {
  SequenceInfo info;
  info.camera = settings.view.camera;
  info.depth_unit_m = settings.sensor.depth_unit_m;
  info.fps = settings.fps;
  info.frames = frames;
  info.surface = !settings.rest.empty();
  info.own_surfaces = settings.rest.empty();
  info.subject = !settings.subject.empty();
  if (info.surface) {
    for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  }
  info.provenance = {
      {"made_by", "vitruvia import"}, {"import", WriteSettings(settings)}, {"build", Provenance()}};
  return info;
}

DepthImage Measured(const DepthImage& depth, const MeshSequenceSettings& settings, int frame) {
  RandomStream noise(static_cast<std::uint64_t>(settings.seed), fmt::format("sensor/{}", frame));
  return Measure(depth, settings.view.camera, settings.sensor, noise);
}

// Meshes that correspond to the subject's template.
void ImportCorrespondingMeshes(const MeshSequenceSettings& settings, const FrameFiles& files,
                               const fs::path& folder) {
  const BodyModel subject = ReadBodyModel(settings.subject);
  const TriangleMesh rest = ReadMesh(settings.rest, settings.unit_m);
  RequireRestMeshOf(subject, settings.subject, rest, settings.rest);
  const PinholeCamera& camera = settings.view.camera;
  const JointFinder joints(subject, rest);
  ZBuffer zbuffer(camera);
  const auto count = static_cast<int>(files.files.size());
  SequenceWriter writer(folder, InfoOf(settings, count), subject, rest);
  ViewWatch watch(camera);
  Progress progress("import " + folder.filename().string(), count);
  for (int i = 0; i < count; ++i) {
    const fs::path& file = files.files[static_cast<std::size_t>(i)];
    const TriangleMesh mesh = ReadFrame(file, settings);
    RequireSameMesh(file, mesh, rest);
    watch.Look(mesh.vertices, i);
    const DepthImage& depth = zbuffer.Render(mesh.vertices, mesh.triangles);
    const std::vector<Vector3d> found = joints.Find(mesh.vertices);
    writer.Append(Measured(depth, settings, i), mesh.vertices,
                  {found, VisibleJoints(found, depth, camera)});
    progress.Advance();
  }
  PublishChecked(writer, folder, {files.warning, watch.Warning(count)});
}

// Refuses a mesh that is mirrored or whose triangles face inwards. The volume is taken about the
// mesh's middle, where that of an open surface is positive too.
constexpr double kInwardVolume_m3 = -0.02;  // a person has 0.05 to 0.1
void RequireOutwards(const TriangleMesh& mesh, const fs::path& file) {
  const Vector3f middle = BoundingBox(mesh.vertices).center();
  TriangleMesh centered = mesh;
  for (Vector3f& v : centered.vertices) v -= middle;
  const double volume_m3 = EnclosedVolume(centered);
  if (volume_m3 < kInwardVolume_m3)
    throw DataError(
        fmt::format("{}: the triangles face inwards (volume {:.3f} m³); is the mesh mirrored?",
                    file.string(), volume_m3));
}

// Imports meshes without correspondence to a template, each with its own triangles.
void ImportOwnSurfaces(const MeshSequenceSettings& settings, const FrameFiles& files,
                       const fs::path& folder) {
  std::optional<BodyModel> subject;
  if (!settings.subject.empty()) subject = ReadBodyModel(settings.subject);
  ZBuffer zbuffer(settings.view.camera);
  const auto count = static_cast<int>(files.files.size());
  SequenceWriter writer(folder, InfoOf(settings, count), subject);
  ViewWatch watch(settings.view.camera);
  Progress progress("import " + folder.filename().string(), count);
  for (int i = 0; i < count; ++i) {
    const TriangleMesh mesh = ReadFrame(files.files[static_cast<std::size_t>(i)], settings);
    RequireOutwards(mesh, files.files[static_cast<std::size_t>(i)]);
    watch.Look(mesh.vertices, i);
    const DepthImage& depth = zbuffer.Render(mesh.vertices, mesh.triangles);
    writer.Append(Measured(depth, settings, i), mesh, JointTruth());
    progress.Advance();
  }
  PublishChecked(writer, folder, {files.warning, watch.Warning(count)});
}

}  // namespace

void MeshSequenceSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "what the sequence shows"});
  f.File("meshes", meshes,
         {.meaning = "folder of .obj, .ply or .off files, one for each frame in the order of the "
                     "numbers in their names, which may differ in nothing else; `rest` is none of "
                     "them",
          .required = true});
  f.File("subject", subject,
         {.meaning = "folder of the subject: mesh.ply, subject.json, weights.bin (FORMAT.md); "
                     "without it whoever tracks the sequence has to name one"});
  f.File(
      "rest", rest,
      {.meaning = "the mesh of the frames in the rest pose of the subject, subject frame; without "
                  "it the mesh of each frame is a true surface with triangles of its own"});
  f.Choice("frame", frame, {{"subject", MeshFrame::kSubject}, {"camera", MeshFrame::kCamera}},
           {.meaning = "frame of reference of the frames' meshes: subject (y up, front to +z) or "
                       "camera (y down, z away)"});
  f.Number("unit_m", unit_m,
           {.meaning = "unit of length of the frames and the rest mesh",
            .unit = "m",
            .min = 1e-6,
            .max = 1e3});
  f.Section(
      "view", view,
      {.meaning = "the camera; its position is used only if the meshes are in the subject frame"});
  f.Section("sensor", sensor, {.meaning = "sensor model of the camera"});
  f.Number("fps", fps, {.meaning = "frames per second", .unit = "1/s", .min = 1e-3, .max = 1e4});
  f.Integer("seed", seed, {.meaning = "seed of the sensor's noise", .min = 0, .max = 1e9});
}

std::string MeshSequenceSettings::Problem() const {
  if (!rest.empty() && subject.empty())
    return "rest: names the rest pose of a subject, but `subject` names none";
  return "";
}

void ImportMeshSequence(const MeshSequenceSettings& settings, const fs::path& folder) {
  const FrameFiles files =
      FindFrameFiles(settings.meshes, IsMeshFile, {settings.rest}, ".obj, .ply or .off files");
  if (settings.rest.empty()) {
    ImportOwnSurfaces(settings, files, folder);
  } else {
    ImportCorrespondingMeshes(settings, files, folder);
  }
}

}  // namespace vitruvia
