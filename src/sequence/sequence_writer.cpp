#include <cerrno>
#include <fstream>
#include <stdexcept>

#include "core/error.h"
#include "core/files.h"
#include "core/write_failure.h"
#include "geometry/depth_png.h"
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

  void AppendFrame(const DepthImage& depth, const JointTruth& truth) {
    const int frame = static_cast<int>(joints.size());
    Require(frame < info.frames, "SequenceWriter::Append: frame {} of {}", frame, info.frames);
    Require(depth.width() == info.camera.width && depth.height() == info.camera.height,
            "SequenceWriter::Append: depth of {}×{} pixels, expected {}×{}", depth.width(),
            depth.height(), info.camera.width, info.camera.height);
    const std::string problem = JointTruthProblem(truth, info.joints.size());
    Require(problem.empty(), "SequenceWriter::Append: frame {}: {}", frame, problem);
    const std::string misfit = DepthPngProblem(depth, info.depth_unit_m);
    if (!misfit.empty())
      throw DataError(fmt::format("{}: depth of frame {}: {}, or its unit is not the one stated",
                                  folder.string(), frame, misfit));
    WriteDepthPng(files.Depth(frame), depth, info.depth_unit_m);
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
  const int frame = static_cast<int>(s.joints.size());
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
  Require(!state_->info.surface,
          "SequenceWriter::Append: no vertices of a sequence with a surface");
  state_->AppendFrame(depth, joints);
}

void SequenceWriter::Note(const std::string& key, Json value) {
  state_->info.provenance[key] = std::move(value);
}

fs::path SequenceWriter::Complete() {
  State& s = *state_;
  if (static_cast<int>(s.joints.size()) != s.info.frames) {
    throw std::logic_error(fmt::format("SequenceWriter::Complete: {} of {} frames were appended",
                                       s.joints.size(), s.info.frames));
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
