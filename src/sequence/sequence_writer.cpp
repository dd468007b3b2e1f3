#include <cerrno>
#include <fstream>
#include <stdexcept>

#include "core/error.h"
#include "core/files.h"
#include "core/worker_team.h"
#include "core/write_failure.h"
#include "geometry/depth_png.h"
#include "geometry/mask_png.h"
#include "geometry/mesh_io.h"
#include "sequence/sequence_files.h"

namespace vitruvia {
namespace fs = std::filesystem;

struct SequenceWriter::State {
  fs::path folder;  // where the sequence will be
  StagedFolder staged;
  SequenceFiles files;
  SequenceInfo info;
  std::size_t vertex_count;
  std::ofstream vertices;
  std::vector<JointTruth> joints;  // one for each frame appended

  State(fs::path folder_in, SequenceInfo info_in, std::size_t vertex_count_in)
      : folder(std::move(folder_in)),
        staged(folder, "sequence.json"),
        files{staged.path()},
        info(std::move(info_in)),
        vertex_count(vertex_count_in) {}

  void RequireWritten() const {
    if (!vertices) FailToWrite(files.Vertices(), errno);
  }

  void WriteHeader() const {
    WriteWholeFile(files.Header(), SequenceInfoJson(info).dump(2) + "\n");
  }

  void WriteSubject(const BodyModel& subject) const {
    MakeFolder(files.Subject());
    WriteBodyModel(files.Subject(), subject);
  }

  int frames() const { return static_cast<int>(joints.size()); }

  void WriteDepth(int frame, const DepthImage& depth) const {
    Require(frame < info.frames, "SequenceWriter::Append: frame {} of {}", frame, info.frames);
    Require(depth.width() == info.camera.width && depth.height() == info.camera.height,
            "SequenceWriter::Append: depth of {}×{} pixels, expected {}×{}", depth.width(),
            depth.height(), info.camera.width, info.camera.height);
    const std::string misfit = DepthPngProblem(depth, info.depth_unit_m);
    if (!misfit.empty())
      throw DataError(fmt::format("{}: depth of frame {}: {}, or its unit is not the one stated",
                                  folder.string(), frame, misfit));
    WriteDepthPng(files.Depth(frame), depth, info.depth_unit_m);
  }

  void AppendFrame(const DepthImage& depth, const JointTruth& truth) {
    const std::string problem = JointTruthProblem(truth, info.joints.size());
    Require(problem.empty(), "SequenceWriter::Append: frame {}: {}", frames(), problem);
    WriteDepth(frames(), depth);
    joints.push_back(truth);
  }

  static std::unique_ptr<State> Begun(fs::path folder, SequenceInfo info, std::size_t vertices);
};

std::unique_ptr<SequenceWriter::State> SequenceWriter::State::Begun(fs::path folder,
                                                                    SequenceInfo info,
                                                                    std::size_t vertices) {
  const std::string problem = SequenceInfoProblem(info);
  Require(problem.empty(), "SequenceWriter: {}", problem);
  auto state = std::make_unique<State>(std::move(folder), std::move(info), vertices);
  MakeFolder(state->files.DepthFolder());
  if (state->info.surface || !state->info.joints.empty()) MakeFolder(state->files.TruthFolder());
  if (state->info.own_surfaces) MakeFolder(state->files.SurfaceFolder());
  return state;
}

SequenceWriter::SequenceWriter(fs::path folder, SequenceInfo info, const BodyModel& subject,
                               const TriangleMesh& true_rest_mesh)
    : state_(State::Begun(std::move(folder), std::move(info), true_rest_mesh.vertices.size())) {
  Require(state_->info.surface, "SequenceWriter: info.surface is false, got a true surface");
  WriteMesh(state_->files.Mesh(), true_rest_mesh);
  state_->WriteSubject(subject);
  errno = 0;
  state_->vertices.open(state_->files.Vertices(), std::ios::binary);
  state_->RequireWritten();
}

SequenceWriter::SequenceWriter(fs::path folder, SequenceInfo info,
                               const std::optional<BodyModel>& subject)
    : state_(State::Begun(std::move(folder), std::move(info), 0)) {
  Require(!state_->info.surface, "SequenceWriter: info.surface is true, got no true surface");
  Require(state_->info.subject == subject.has_value(),
          "SequenceWriter: info.subject is {}, got {} subject", state_->info.subject,
          subject ? "a" : "no");
  if (subject) state_->WriteSubject(*subject);
}

SequenceWriter::~SequenceWriter() = default;

void SequenceWriter::Append(const DepthImage& depth, const std::vector<Vector3f>& true_vertices,
                            const JointTruth& joints) {
  State& s = *state_;
  const int frame = s.frames();
  Require(s.info.surface, "SequenceWriter::Append: vertices of a sequence without a surface");
  Require(true_vertices.size() == s.vertex_count,
          "SequenceWriter::Append: {} vertices, expected {}", true_vertices.size(), s.vertex_count);
  for (std::size_t i = 0; i < true_vertices.size(); ++i) {
    Require(true_vertices[i].allFinite(),
            "SequenceWriter::Append: vertex {} of frame {} is not finite", i, frame);
  }
  s.AppendFrame(depth, joints);
  s.vertices.write(reinterpret_cast<const char*>(true_vertices.data()),
                   static_cast<std::streamsize>(true_vertices.size() * sizeof(Vector3f)));
  s.RequireWritten();
}

void SequenceWriter::Append(const DepthImage& depth, const JointTruth& joints) {
  Require(!state_->info.surface && !state_->info.own_surfaces,
          "SequenceWriter::Append: no vertices of a sequence with a surface");
  state_->AppendFrame(depth, joints);
}

void SequenceWriter::Append(const DepthImage& depth, const TriangleMesh& true_surface,
                            const JointTruth& joints) {
  State& s = *state_;
  const int frame = s.frames();
  Require(s.info.own_surfaces, "SequenceWriter::Append: a surface of a sequence without them");
  Require(!true_surface.triangles.empty(), "SequenceWriter::Append: frame {} has no triangles",
          frame);
  s.AppendFrame(depth, joints);
  WriteMesh(s.files.Surface(frame), true_surface);
}

void SequenceWriter::Append(const std::vector<DepthImage>& depths, WorkerTeam& team) {
  State& s = *state_;
  Require(!s.info.surface && !s.info.own_surfaces && s.info.joints.empty(),
          "SequenceWriter::Append: no truth for frames of a sequence with truth");
  const int first = s.frames();
  team.For(static_cast<int>(depths.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) s.WriteDepth(first + i, depths[static_cast<std::size_t>(i)]);
  });
  s.joints.resize(s.joints.size() + depths.size());
}

void SequenceWriter::WriteMask(int frame, const MaskImage& mask) const {
  const State& s = *state_;
  Require(frame >= 0 && frame < s.frames(), "SequenceWriter::WriteMask: frame {} of {}", frame,
          s.frames());
  Require(mask.width() == s.info.camera.width && mask.height() == s.info.camera.height,
          "SequenceWriter::WriteMask: mask of {}×{} pixels, expected {}×{}", mask.width(),
          mask.height(), s.info.camera.width, s.info.camera.height);
  MakeFolder(s.files.MaskFolder());
  WriteMaskPng(s.files.Mask(frame), mask);
}

void SequenceWriter::WriteViewDepth(int view, int frame, const DepthImage& depth) const {
  const OtherView& other = state_->info.views.at(static_cast<std::size_t>(view));
  Require(depth.width() == other.camera.width && depth.height() == other.camera.height,
          "SequenceWriter::WriteViewDepth: depth of {}×{} pixels, expected {}×{}", depth.width(),
          depth.height(), other.camera.width, other.camera.height);
  MakeFolder(state_->files.ViewFolder(other.name));
  WriteDepthPng(state_->files.ViewDepth(other.name, frame), depth, state_->info.depth_unit_m);
}

void SequenceWriter::WriteEmptyRoom(int frame, const DepthImage& depth) const {
  MakeFolder(state_->files.EmptyRoomFolder());
  WriteDepthPng(state_->files.EmptyRoom(frame), depth, state_->info.depth_unit_m);
}

void SequenceWriter::WritePreview(std::string_view png) const {
  WriteWholeFile(state_->files.Preview(), png);
}

void SequenceWriter::Note(const std::string& key, Json value) {
  state_->info.provenance[key] = std::move(value);
}

fs::path SequenceWriter::Complete() {
  State& s = *state_;
  if (s.frames() != s.info.frames) {
    throw std::logic_error(fmt::format("SequenceWriter::Complete: {} of {} frames were appended",
                                       s.frames(), s.info.frames));
  }
  if (s.info.surface) {
    s.vertices.close();
    s.RequireWritten();
  }
  if (!s.info.joints.empty())
    WriteWholeFile(s.files.Joints(), JointTruthJson(s.info.joints, s.joints).dump() + "\n");
  s.WriteHeader();
  return s.staged.path();
}

void SequenceWriter::Finish() {
  Complete();
  Publish();
}

void SequenceWriter::Publish() {
  state_->WriteHeader();  // with what was noted since Complete()
  state_->staged.Commit();
}

}  // namespace vitruvia
