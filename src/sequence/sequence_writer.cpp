#include <fstream>
#include <stdexcept>

#include "core/error.h"
#include "core/files.h"
#include "geometry/depth_png.h"
#include "geometry/mesh_io.h"
#include "sequence/sequence_files.h"

namespace vitruvia {
namespace fs = std::filesystem;

struct SequenceWriter::State {
  StagedFolder staged;
  SequenceFiles files;
  SequenceInfo info;
  std::size_t vertex_count;
  std::ofstream vertices;
  std::vector<JointTruth> joints;  // one for each frame appended

  State(fs::path folder, SequenceInfo info_in, std::size_t vertex_count_in)
      : staged(std::move(folder), "sequence.json"),
        files{staged.path()},
        info(std::move(info_in)),
        vertex_count(vertex_count_in) {}

  void RequireWritten() const {
    if (!vertices) throw RunError(fmt::format("{}: cannot be written", files.Vertices().string()));
  }
};

SequenceWriter::SequenceWriter(fs::path folder, SequenceInfo info, const BodyModel& subject,
                               const TriangleMesh& true_rest_mesh) {
  const std::string problem = SequenceInfoProblem(info);
  Require(problem.empty(), "SequenceWriter: {}", problem);
  state_ =
      std::make_unique<State>(std::move(folder), std::move(info), true_rest_mesh.vertices.size());
  const SequenceFiles& files = state_->files;
  MakeFolder(files.DepthFolder());
  MakeFolder(files.TruthFolder());
  MakeFolder(files.Subject());
  WriteMesh(files.Mesh(), true_rest_mesh);
  WriteBodyModel(files.Subject(), subject);
  state_->vertices.open(files.Vertices(), std::ios::binary);
  state_->RequireWritten();
}

SequenceWriter::~SequenceWriter() = default;

void SequenceWriter::Append(const DepthImage& depth, const std::vector<Vector3f>& true_vertices,
                            const JointTruth& joints) {
  State& s = *state_;
  const int frame = static_cast<int>(s.joints.size());
  Require(frame < s.info.frames, "SequenceWriter::Append: frame {} of {}", frame, s.info.frames);
  Require(depth.width() == s.info.camera.width && depth.height() == s.info.camera.height,
          "SequenceWriter::Append: depth of {}×{} pixels, expected {}×{}", depth.width(),
          depth.height(), s.info.camera.width, s.info.camera.height);
  Require(true_vertices.size() == s.vertex_count,
          "SequenceWriter::Append: {} vertices, expected {}", true_vertices.size(), s.vertex_count);
  for (std::size_t i = 0; i < true_vertices.size(); ++i) {
    Require(true_vertices[i].allFinite(),
            "SequenceWriter::Append: vertex {} of frame {} is not finite", i, frame);
  }
  const std::string problem = JointTruthProblem(joints, s.info.joints.size());
  Require(problem.empty(), "SequenceWriter::Append: frame {}: {}", frame, problem);

  WriteDepthPng(s.files.Depth(frame), depth, s.info.depth_unit_m);
  s.vertices.write(reinterpret_cast<const char*>(true_vertices.data()),
                   static_cast<std::streamsize>(true_vertices.size() * sizeof(Vector3f)));
  s.RequireWritten();
  s.joints.push_back(joints);
}

void SequenceWriter::Note(const std::string& key, Json value) {
  state_->info.provenance[key] = std::move(value);
}

void SequenceWriter::Finish() {
  State& s = *state_;
  if (static_cast<int>(s.joints.size()) != s.info.frames) {
    throw std::logic_error(fmt::format("SequenceWriter::Finish: {} of {} frames were appended",
                                       s.joints.size(), s.info.frames));
  }
  s.vertices.close();
  s.RequireWritten();
  WriteWholeFile(s.files.Joints(), JointTruthJson(s.info.joints, s.joints).dump() + "\n");
  WriteWholeFile(s.files.Header(), SequenceInfoJson(s.info).dump(2) + "\n");
  s.staged.Commit();
}

}  // namespace vitruvia
