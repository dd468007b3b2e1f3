#include "experiments/mesh_import.h"

#include <algorithm>

#include "core/build_info.h"
#include "core/error.h"
#include "core/json_settings.h"
#include "core/progress.h"
#include "geometry/mesh_io.h"
#include "geometry/surface_map.h"
#include "geometry/zbuffer.h"
#include "metrics/bone_motion.h"
#include "sequence/sequence.h"
#include "synth/scene/recording.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// Vertices that nearly follow one bone alone show where it is.
constexpr float kFollowsOneBone = 0.9f;
constexpr std::size_t kFewestOfBone = 3;
constexpr float kNearestToCamera_m = 0.1f;

std::vector<fs::path> MeshFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".obj" || extension == ".ply" || extension == ".off")
      files.push_back(entry.path());
  }
  if (files.empty())
    throw DataError(fmt::format("{}: expected a folder of .obj, .ply or .off files, found none",
                                folder.string()));
  std::sort(files.begin(), files.end());
  return files;
}

TriangleMesh ReadScaled(const fs::path& file, double unit_m) {
  TriangleMesh mesh = ReadMesh(file);
  for (Vector3f& v : mesh.vertices) v *= static_cast<float>(unit_m);
  return mesh;
}

// Where the subject's joints are, given the true surface in some pose.
class JointFinder {
 public:
  JointFinder(const BodyModel& subject, const TriangleMesh& true_rest)
      : subject_(subject),
        on_truth_(ClosestSurfacePoints(subject.rest.vertices, true_rest)),
        triangles_(true_rest.triangles),
        of_bone_(kBoneCount),
        parts_(subject.rest.vertices, BoneOfVertex(subject), kBoneCount) {
    const std::vector<int> bones = BoneOfVertex(subject);
    for (std::size_t v = 0; v < bones.size(); ++v) {
      if (bones[v] >= 0) of_bone_[bones[v]].push_back(v);
    }
    for (int b = 0; b < kBoneCount; ++b) {
      if (of_bone_[b].size() >= kFewestOfBone) continue;
      throw DataError(
          fmt::format("subject: {} vertices follow the bone {} alone, expected at least "
                      "{}: its joint cannot be found on the meshes",
                      of_bone_[b].size(), Bones()[b].name, kFewestOfBone));
    }
  }

  std::vector<Vector3d> Find(const std::vector<Vector3f>& true_vertices) const {
    std::vector<Vector3f> posed;
    for (const SurfacePoint& point : on_truth_)
      posed.push_back(Evaluate(point, true_vertices.data(), triangles_));
    const BoneRotations rotations = parts_.Rotations(posed);
    std::vector<Vector3d> joints;
    for (int b = 0; b < kBoneCount; ++b) {
      joints.push_back(Middle(posed, b) + rotations[b] * (subject_.skeleton.joints[b] -
                                                          Middle(subject_.rest.vertices, b)));
    }
    return joints;
  }

 private:
  static std::vector<int> BoneOfVertex(const BodyModel& subject) {
    std::vector<int> bones;
    for (std::size_t v = 0; v < subject.rest.vertices.size(); ++v) {
      const bool follows_one = subject.weights.weights[v][0] >= kFollowsOneBone;
      bones.push_back(follows_one ? subject.weights.bones[v][0] : -1);
    }
    return bones;
  }

  Vector3d Middle(const std::vector<Vector3f>& vertices, int bone) const {
    Vector3d sum = Vector3d::Zero();
    for (const std::size_t v : of_bone_[bone]) sum += vertices[v].cast<double>();
    return sum / static_cast<double>(of_bone_[bone].size());
  }

  const BodyModel& subject_;
  std::vector<SurfacePoint> on_truth_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::size_t>> of_bone_;
  RigidParts parts_;
};

// The vertices of one frame, camera frame.
std::vector<Vector3f> ReadFrame(const fs::path& file, const MeshSequenceSettings& settings,
                                const TriangleMesh& rest) {
  TriangleMesh mesh = ReadScaled(file, settings.unit_m);
  if (mesh.vertices.size() != rest.vertices.size() || mesh.triangles != rest.triangles) {
    throw DataError(fmt::format(
        "{}: expected the {} vertices and {} triangles of the rest mesh in their order, got {} and "
        "{}{}",
        file.string(), rest.vertices.size(), rest.triangles.size(), mesh.vertices.size(),
        mesh.triangles.size(),
        mesh.triangles.size() == rest.triangles.size() ? " (other triangles)" : ""));
  }
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
  return mesh.vertices;
}

SequenceInfo InfoOf(const MeshSequenceSettings& settings, int frames) {
  SequenceInfo info;
  info.camera = settings.view.camera;
  info.depth_unit_m = settings.sensor.depth_unit_m;
  info.fps = settings.fps;
  info.frames = frames;
  for (const BoneInfo& bone : Bones()) info.joints.emplace_back(bone.joint);
  info.provenance = {
      {"made_by", "vitruvia import"}, {"import", WriteSettings(settings)}, {"build", Provenance()}};
  return info;
}

}  // namespace

void MeshSequenceSettings::Describe(Fields& f) {
  f.Text("title", title, {.meaning = "what the sequence shows"});
  f.File("meshes", meshes,
         {.meaning = "folder of .obj, .ply or .off files, one for each frame in the order of their "
                     "names",
          .required = true});
  f.File("subject", subject,
         {.meaning = "folder of the subject: mesh.ply, subject.json, weights.bin (FORMAT.md)",
          .required = true});
  f.File("rest", rest,
         {.meaning = "the same mesh in the subject's rest pose, subject frame", .required = true});
  f.Choice("frame", frame, {{"subject", MeshFrame::kSubject}, {"camera", MeshFrame::kCamera}},
           {.meaning = "frame of reference of the frames' meshes: subject (y up, front to +z) or "
                       "camera (y down, z away)"});
  f.Number("unit_m", unit_m,
           {.meaning = "length that 1 stands for in frames and rest mesh",
            .unit = "m",
            .min = 1e-6,
            .max = 1e3});
  f.Section("view", view, {.meaning = "the camera; its place counts only for the subject frame"});
  f.Section("sensor", sensor, {.meaning = "what the camera makes of true depth"});
  f.Number("fps", fps, {.meaning = "frames per second", .unit = "1/s", .min = 1e-3, .max = 1e4});
  f.Integer("seed", seed, {.meaning = "seed of the sensor's noise", .min = 0, .max = 1e9});
}

void ImportMeshSequence(const MeshSequenceSettings& settings, const fs::path& folder) {
  const std::vector<fs::path> files = MeshFiles(settings.meshes);
  const BodyModel subject = ReadBodyModel(settings.subject);
  const TriangleMesh rest = ReadScaled(settings.rest, settings.unit_m);
  const PinholeCamera& camera = settings.view.camera;
  const JointFinder joints(subject, rest);
  ZBuffer zbuffer(camera);
  const auto count = static_cast<int>(files.size());
  SequenceWriter writer(folder, InfoOf(settings, count), subject, rest);
  Progress progress("import " + folder.filename().string(), count);
  for (int i = 0; i < count; ++i) {
    const std::vector<Vector3f> vertices = ReadFrame(files[i], settings, rest);
    const DepthImage& depth = zbuffer.Render(vertices, rest.triangles);
    const std::vector<Vector3d> found = joints.Find(vertices);
    RandomStream noise(static_cast<std::uint64_t>(settings.seed), fmt::format("sensor/{}", i));
    writer.Append(Measure(depth, camera, settings.sensor, noise), vertices,
                  {found, VisibleJoints(found, depth, camera)});
    progress.Advance();
  }
  writer.Finish();
}

}  // namespace vitruvia
