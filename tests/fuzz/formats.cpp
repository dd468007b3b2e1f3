#include "formats.h"

#include <bit>
#include <fstream>
#include <set>

#include "config/json_settings.h"
#include "core/files.h"
#include "core/hash.h"
#include "experiments/plan/run_plan.h"
#include "experiments/run/run_state.h"
#include "geometry/mask_png.h"
#include "geometry/mesh_io.h"
#include "importers/depth_recording.h"
#include "importers/eval_import.h"
#include "importers/mesh_import.h"
#include "importers/pcd_file.h"
#include "learning/shape/shape_space.h"
#include "methods/dynamic/skeleton_file.h"
#include "records/estimate.h"
#include "records/run_record.h"
#include "sequence/sequence.h"
#include "support/eval_file_writer.h"
#include "support/small_recording.h"
#include "support/tiny_body.h"
#include "synth/mocap_support.h"
#include "verification/verification.h"

namespace vitruvia {
namespace fs = std::filesystem;
namespace {

// ---- what was read, as a hash

void AddTo(Hash64& hash, double value) { hash.Add(&value, sizeof value); }

template <class Derived>
void AddTo(Hash64& hash, const Eigen::DenseBase<Derived>& values) {
  for (Eigen::Index column = 0; column < values.cols(); ++column) {
    for (Eigen::Index row = 0; row < values.rows(); ++row)
      AddTo(hash, static_cast<double>(values.derived()(row, column)));
  }
}

void AddTo(Hash64& hash, const std::vector<Vector3f>& points) {
  for (const Vector3f& p : points) AddTo(hash, p);
}

void AddTo(Hash64& hash, const TriangleMesh& mesh) {
  AddTo(hash, mesh.vertices);
  hash.Add(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
}

void AddTo(Hash64& hash, const BodyModel& body) {
  AddTo(hash, body.rest);
  for (const auto& weights : body.weights.weights) {
    for (const float weight : weights) AddTo(hash, weight);
  }
  for (int bone = 0; bone < kBoneCount; ++bone) {
    AddTo(hash, body.skeleton.joints[static_cast<std::size_t>(bone)]);
    AddTo(hash, body.skeleton.tips[static_cast<std::size_t>(bone)]);
  }
  hash.Add(body.name);
  AddTo(hash, body.attributes.height_m);
  AddTo(hash, body.attributes.weight_kg);
  AddTo(hash, static_cast<double>(body.attributes.sex));
}

std::string MeaningOf(const Motion& motion) {
  Hash64 hash;
  AddTo(hash, motion.duration_s());
  for (double share = 0.0; share <= 1.0; share += 0.125) {
    const MotionSample sample = motion.At(share * motion.duration_s());
    for (const Matrix3<double>& rotation : sample.pose.local_rotations) AddTo(hash, rotation);
    AddTo(hash, sample.pose.pelvis_position);
    AddTo(hash, sample.clearance_m);
  }
  return hash.Hex();
}

std::string MeaningOf(const SequenceReader& sequence) {
  const SequenceInfo& info = sequence.info();
  Hash64 hash;
  for (const double value : {info.camera.fx, info.camera.fy, info.camera.cx, info.camera.cy,
                             info.depth_unit_m, info.fps})
    AddTo(hash, value);
  for (const std::string& joint : info.joints) hash.Add(joint);
  for (int i = 0; i < info.frames; ++i) {
    const DepthImage depth = sequence.ReadDepth(i);
    for (const float z : depth.pixels()) AddTo(hash, z);
    if (info.surface) AddTo(hash, sequence.ReadTrueVertices(i));
    if (info.joints.empty()) continue;
    const JointTruth& truth = sequence.true_joints(i);
    for (std::size_t j = 0; j < truth.positions.size(); ++j) {
      AddTo(hash, truth.positions[j]);
      AddTo(hash, truth.visible[j] ? 1.0 : 0.0);
      AddTo(hash, truth.Knows(j) ? 1.0 : 0.0);
    }
  }
  if (info.surface) AddTo(hash, sequence.true_rest_mesh());
  if (info.subject) AddTo(hash, sequence.subject());
  return hash.Hex();
}

// As `vitruvia verify` does.
Reading Verified(const fs::path& folder) {
  VerifySequence(folder);
  const SequenceReader sequence(folder);
  Reading reading{MeaningOf(sequence), RequireConsistent(sequence, FrameSelection::kAll, folder)};
  const Json& provenance = sequence.info().provenance;
  if (provenance.contains("warnings")) reading.warnings.push_back(provenance.at("warnings").dump());
  return reading;
}

// ---- how formats are mutated

Mutant MutateAsText(const std::string& /*file*/, const std::string& content, RandomStream& random) {
  return MutateText(content, random);
}

// A place of a JSON document in one of these sections.
bool IsIn(const std::string& place, const std::set<std::string>& sections) {
  return sections.contains(place.substr(0, place.find('/', 1)));
}

const JsonRules kConfigRules{[](const std::string&) { return false; }, true};

// What a sequence's JSON files leave open.
const JsonRules kSequenceRules{
    [](const std::string& place) { return IsIn(place, {"/provenance"}); }, false};

constexpr std::string_view kEndOfPlyHeader = "end_header\n";

Mutant MutateByName(const std::string& file, const std::string& content, const JsonRules& rules,
                    RandomStream& random) {
  const std::string extension = fs::path(file).extension().string();
  if (extension == ".json") return MutateJson(content, rules, random);
  if (extension == ".png") return MutateBytes(content, content.size(), random);
  if (extension == ".ply")
    return MutateBytes(content, content.find(kEndOfPlyHeader) + kEndOfPlyHeader.size(), random);
  if (extension == ".bin") return MutateBytes(content, 0, random);
  return MutateText(content, random);
}

auto ByNameWith(const JsonRules& rules) {
  return [rules](const std::string& file, const std::string& content, RandomStream& random) {
    return MutateByName(file, content, rules, random);
  };
}

// ---- motions

std::vector<TestFrame> FewFrames() {
  std::vector<TestFrame> frames = Wriggle();
  frames.resize(4);
  return frames;
}

MutatedFormat Bvh() {
  return {"bvh",
          [](const fs::path& folder) {
            WriteWholeFile(folder / "clip.bvh", TestBvh(TestSkeleton()).Text(FewFrames()));
          },
          {"clip.bvh"},
          MutateAsText,
          [](const fs::path& folder) -> Reading {
            const auto motion = LoadBvh(folder / "clip.bvh", TestSkeleton());
            return {MeaningOf(*motion), motion->warnings()};
          }};
}

MutatedFormat AsfAmc() {
  return {
      "asf_amc",
      [](const fs::path& folder) {
        WriteWholeFile(folder / "clip.asf", kTestAsf);
        WriteWholeFile(
            folder / "clip.amc",
            Amc(AmcFrame(1, {{"head", "0 40 0"}}) +
                AmcFrame(2, {{"lfemur", "-30 0 -20"}, {"lradius", "20"}}) +
                AmcFrame(3, {{"rfemur", "-30 0 20"}, {"rtibia", "25"}, {"root", "0 17 1 0 5 0"}})));
      },
      {"clip.asf", "clip.amc"},
      MutateAsText,
      [](const fs::path& folder) -> Reading {
        const auto motion = LoadAsfAmc(folder / "clip.amc", folder / "clip.asf", TestSkeleton());
        return {MeaningOf(*motion), motion->warnings()};
      }};
}

MutatedFormat Keyframes() {
  return {"keyframes",
          [](const fs::path& folder) {
            fs::copy_file(fs::path(VITRUVIA_SOURCE_DIR) / "configs/motions/crouch.json",
                          folder / "motion.json");
          },
          {"motion.json"},
          ByNameWith(kConfigRules),
          [](const fs::path& folder) -> Reading {
            MotionSettings settings;
            settings.file = folder / "motion.json";
            const auto motion = LoadMotion(settings, TestSkeleton());
            return {MeaningOf(*motion), motion->warnings()};
          }};
}

// ---- meshes

Reading ReadingOfMesh(const fs::path& file) {
  Hash64 hash;
  AddTo(hash, ReadMesh(file));
  return {hash.Hex(), {}};
}

// Everything that the format allows beside vertices and faces.
std::string TextPly(const TriangleMesh& mesh) {
  std::string text = fmt::format(
      "ply\ncomment by a test\nformat ascii 1.0\nelement extra 1\nproperty list uchar int things\n"
      "element vertex {}\nproperty double x\nproperty float y\nproperty float z\n"
      "property uchar red\nelement face {}\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n2 7 8\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vector3f& v : mesh.vertices)
    text += fmt::format("{:.9g} {:.9g} {:.9g} 255\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles)
    text += fmt::format("3 {} {} {} 2 0.5 0.25\n", a, b, c);
  return text;
}

template <class Value>
void AppendBigEndian(Value value, std::string& bytes) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
  bytes.append(raw.rbegin(), raw.rend());
}

std::string BigEndianPly(const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_big_endian 1.0\nelement face {}\n"
      "property list uchar uint vertex_index\nelement vertex {}\n"
      "property float z\nproperty double x\nproperty float y\nend_header\n",
      mesh.triangles.size(), mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles) {
    bytes += '\3';
    for (const std::int32_t v : triangle) AppendBigEndian(v, bytes);
  }
  for (const Vector3f& v : mesh.vertices) {
    AppendBigEndian(v.z(), bytes);
    AppendBigEndian(static_cast<double>(v.x()), bytes);
    AppendBigEndian(v.y(), bytes);
  }
  return bytes;
}

MutatedFormat Ply() {
  return {
      "ply",
      [](const fs::path& folder) { WriteWholeFile(folder / "mesh.ply", TextPly(TinyBody().rest)); },
      {"mesh.ply"},
      MutateAsText,
      [](const fs::path& folder) { return ReadingOfMesh(folder / "mesh.ply"); }};
}

MutatedFormat BinaryPly(const std::string& name,
                        const std::function<std::string(const TriangleMesh&)>& content) {
  return {name,
          [content](const fs::path& folder) {
            if (content) {
              WriteWholeFile(folder / "mesh.ply", content(TinyBody().rest));
            } else {
              WriteMesh(folder / "mesh.ply", TinyBody().rest);
            }
          },
          {"mesh.ply"},
          ByNameWith({}),
          [](const fs::path& folder) { return ReadingOfMesh(folder / "mesh.ply"); }};
}

MutatedFormat Off() {
  return {"off",
          [](const fs::path& folder) { WriteMesh(folder / "mesh.off", TinyBody().rest); },
          {"mesh.off"},
          MutateAsText,
          [](const fs::path& folder) { return ReadingOfMesh(folder / "mesh.off"); }};
}

// ---- sequences and what they are imported from

MutatedFormat Sequence() {
  return {"sequence",
          [](const fs::path& folder) {
            const SmallRecording recording;
            recording.Write(folder);
            fs::create_directory(folder / "mask");
            for (int i = 0; i < recording.frames; ++i)
              WriteMaskPng(folder / fmt::format("mask/{:06}.png", i),
                           MaskImage(recording.camera.width, recording.camera.height, 255));
          },
          {"sequence.json", "depth/000001.png", "mask/000001.png", "truth/joints.json",
           "truth/mesh.ply", "truth/vertices.bin", "subject/mesh.ply", "subject/subject.json",
           "subject/weights.bin"},
          ByNameWith(kSequenceRules),
          Verified};
}

MutatedFormat ImportedMeshes() {
  return {"import_meshes",
          [](const fs::path& folder) {
            const SmallRecording recording;
            fs::create_directory(folder / "subject");
            WriteBodyModel(folder / "subject", recording.body);
            WriteMesh(folder / "rest.obj", recording.body.rest);
            fs::create_directory(folder / "frames");
            for (int i = 0; i < recording.frames; ++i)
              WriteMesh(folder / fmt::format("frames/{}.obj", i),
                        {recording.InSubject(i), recording.body.rest.triangles});
            MeshSequenceSettings settings;
            settings.meshes = "frames";
            settings.subject = "subject";
            settings.rest = "rest.obj";
            settings.view.camera = recording.camera;
            WriteWholeFile(folder / "import.json", WriteSettings(settings).dump(1) + "\n");
          },
          {"frames/1.obj", "frames/2.obj", "rest.obj", "import.json", "subject/mesh.ply",
           "subject/subject.json", "subject/weights.bin"},
          ByNameWith(kConfigRules),
          [](const fs::path& folder) {
            ImportMeshSequence(ReadSettingsFile<MeshSequenceSettings>(folder / "import.json"),
                               folder / "out");
            return Verified(folder / "out");
          }};
}

MutatedFormat ImportedEval() {
  return {"import_eval",
          [](const fs::path& folder) {
            SmallRecording recording;
            recording.camera = {320, 240, 285.0, 283.0, 160.5, 118.25};
            recording.Write(folder / "original");
            WriteEvalFile(folder / "seq_a_0.bin",
                          EvalFramesOf(SequenceReader(folder / "original"), 100));
            fs::remove_all(folder / "original");
          },
          {"seq_a_0.bin"},
          ByNameWith({}),
          [](const fs::path& folder) {
            ImportEvalSequence({folder / "seq_a_0.bin"}, {}, folder / "out");
            return Verified(folder / "out");
          }};
}

// ---- recordings of depth cameras

// In a cloud NaN and infinity say that nothing was measured.
Mutant MutateCloud(const std::string& /*file*/, const std::string& content, RandomStream& random) {
  Mutant mutant = MutateText(content, random);
  if (mutant.what.find(kNoNumber) != std::string::npos) mutant.change = Change::kStatement;
  return mutant;
}

MutatedFormat TextPcd() {
  return {"pcd",
          [](const fs::path& folder) {
            std::string text =
                "# .PCD v0.7\nVERSION 0.7\nFIELDS x rgb y z\nSIZE 4 1 4 4\nTYPE F U F F\n"
                "COUNT 1 3 1 1\nWIDTH 4\nHEIGHT 3\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 12\n"
                "DATA ascii\n";
            for (int i = 0; i < 12; ++i)
              text += fmt::format("{} 1 2 3 {} {}\n", 0.1 * i, -0.2 * i, 2.0 + 0.01 * i);
            WriteWholeFile(folder / "cloud.pcd", text);
          },
          {"cloud.pcd"},
          MutateCloud,
          [](const fs::path& folder) -> Reading {
            const OrganisedCloud cloud = ReadOrganisedPcd(folder / "cloud.pcd");
            Hash64 hash;
            AddTo(hash, cloud.width);
            AddTo(hash, cloud.points);
            return {hash.Hex(), {}};
          }};
}

MutatedFormat ListOfDepthFiles() {
  return {"depth_list",
          [](const fs::path& folder) {
            std::string text = "# seconds file\n";
            for (int i = 0; i < 8; ++i) {
              WriteWholeFile(folder / fmt::format("{}.png", i), "x");
              text += fmt::format("{:.6f} {}.png\n", 12.0 + i / 30.0, i);
            }
            WriteWholeFile(folder / "depth.txt", text);
          },
          {"depth.txt"},
          MutateAsText,
          [](const fs::path& folder) -> Reading {
            const DepthRecording recording = FindRecordedFrames(folder / "depth.txt");
            std::string meaning = fmt::format("{:.6g}", recording.fps);
            for (const fs::path& frame : recording.frames) meaning += " " + frame.string();
            return {meaning, recording.gaps};
          }};
}

// ---- stored data

MutatedFormat Estimate() {
  const JsonRules rules{[](const std::string& place) {
                          return place == "/tracker_memory_mb" || place.ends_with("/condition") ||
                                 place.ends_with("/energy_rise");
                        },
                        false};
  return {"estimate",
          [](const fs::path& folder) {
            const TriangleMesh mesh = TinyBody().rest;
            EstimateWriter writer(folder, mesh);
            for (int i = 0; i < 2; ++i) {
              TrackResult result;
              result.outcome = i == 0 ? Outcome::kConverged : Outcome::kLost;
              result.message = i == 0 ? "" : "3 of 4 vertices unsupported";
              result.vertices = mesh.vertices;
              result.joints = {{0.1, 0.2, 1.0 / 3.0}};
              result.iterations = 4;
              result.step_ms = {{"render", 0.5}, {"assemble", 0.1}};
              result.energies = {{"data", 2.0 / 3.0}};
              result.condition = 17.0;
              writer.Append(result, 12.5 + i);
            }
            writer.Finish(48.5);
          },
          {"estimate.json", "vertices.bin", "mesh.ply"},
          ByNameWith(rules),
          [](const fs::path& folder) -> Reading {
            const EstimateReader estimate(folder);
            Hash64 hash;
            AddTo(hash, estimate.rest_mesh());
            AddTo(hash, estimate.tracker_memory_mb().value_or(-1.0));
            for (std::size_t i = 0; i < estimate.frames().size(); ++i) {
              hash.Add(StoredJson(estimate.frames()[i]).dump());
              AddTo(hash, estimate.ReadVertices(static_cast<int>(i)));
            }
            return {hash.Hex(), {}};
          }};
}

RunRecord SomeRun() {
  RunRecord r;
  r.run_id = "base.walk.s1";
  r.experiment = "some/experiment";
  r.variant = "base";
  r.scene = "walk";
  r.method = "realtime_scape";
  r.sequence_folder = "../../cache/walk";
  r.sequence_hash = "0123456789abcdef";
  r.config = {{"method", {{"lambda", 0.1}}}};
  r.provenance = {{"commit", "abc"}, {"threads", 2}};
  r.summary = {{"l2_mean_m", 1.0 / 3.0}, {"variant", "base"}};
  r.frames = {{"l2_mean_m", {0.1, 0.2}}, {"l2_mean_hidden_m", {kAbsent, 0.5}}};
  r.threshold_m = {0.0, 0.1, 0.2};
  r.joint_accuracy = {{"all", {0.0, 0.7, 1.0}}, {"hidden", {0.0, 0.1, 0.2}}};
  r.joint_error_mean_m = {{"left_wrist", 0.012345678901234567}, {"head", 0.5}};
  r.steps = {{"render", 0.5, 0.75, 1.0}, {"assemble", 0.1, 0.2, 0.3}};
  r.diagonal_m = 2.5 / 7.0;
  r.warnings = {"depth/: something"};
  return r;
}

MutatedFormat Records() {
  const JsonRules rules{
      [](const std::string& place) {
        return IsIn(place, {"/config", "/provenance", "/summary", "/frames", "/threshold_m",
                            "/joint_accuracy", "/joint_error_mean_m", "/diagonal_m", "/warnings",
                            "/variants", "/rows", "/failed_runs"}) ||
               place.ends_with("/paper") || place.ends_with("/at_most") ||
               place.ends_with("/at_least") || place.ends_with("/scenes") ||
               place.ends_with("/not_comparable");
      },
      false};
  const std::string record = SomeRun().run_id + "/record.json";
  return {"records",
          [](const fs::path& folder) {
            WriteRunRecord(folder, SomeRun());
            ExperimentRecord experiment;
            experiment.name = "some/experiment";
            experiment.expectations = {{"l2_mean_m", 0.01, 0.02, "paper A, figure 11", "a remark"}};
            experiment.run_ids = {SomeRun().run_id};
            WriteExperimentRecord(folder, experiment);
            ExperimentSummary summary;
            summary.experiment = "some/experiment";
            summary.missing_runs = {"other"};
            summary.rows.push_back(SomeRun().summary);
            WriteExperimentSummary(folder, summary);
            WriteStoredPlan(folder, {"build", folder / "exp.json", 0.5, {{"run", "key"}}});
          },
          {record, "experiment.json", "summary.json", "plan.json"},
          ByNameWith(rules),
          [](const fs::path& folder) -> Reading {
            return {StoredJson(ReadRunRecord(folder, SomeRun().run_id)).dump() +
                        StoredJson(ReadExperimentRecord(folder)).dump() +
                        StoredJson(ReadSummary(folder)).dump() +
                        StoredJson(ReadStoredPlan(folder)).dump(),
                    {}};
          }};
}

MutatedFormat StoredShapeSpace() {
  return {"shape_space",
          [](const fs::path& folder) {
            constexpr Eigen::Index kComponents = 2;
            ShapeSpace space;
            space.reference = TinyBody();
            const auto rows = static_cast<Eigen::Index>(3 * space.reference.rest.vertices.size());
            space.mean = Eigen::VectorXf::LinSpaced(rows, -1.0f, 1.0f);
            space.basis = Eigen::MatrixXf::Identity(rows, kComponents);
            space.joint_mean = Eigen::VectorXd::LinSpaced(6 * kBoneCount, -1.0, 1.0);
            space.joint_basis = Eigen::MatrixXd::Identity(6 * kBoneCount, kComponents);
            space.place_mean = {0.0, 1.0, 0.0};
            space.place_basis = Eigen::MatrixXd::Identity(3, kComponents);
            space.attribute_mean = {1.7, 70.0, 0.5};
            space.attribute_basis = Eigen::MatrixXd::Identity(kAttributeCount, kComponents);
            space.density_kg_m3 = {1000.0, 1010.0};
            WriteShapeSpace(folder, space);
          },
          {"space.json", "mean.bin", "basis.bin", "joint_mean.bin", "density.bin"},
          ByNameWith({}),
          [](const fs::path& folder) -> Reading {
            const ShapeSpace space = ReadShapeSpace(folder);
            Hash64 hash;
            AddTo(hash, space.reference);
            AddTo(hash, space.mean);
            AddTo(hash, space.basis);
            AddTo(hash, space.joint_mean);
            AddTo(hash, space.density_kg_m3);
            return {hash.Hex(), {}};
          }};
}

// ---- configs

MutatedFormat Configs() {
  return {"configs",
          [](const fs::path& folder) {
            const fs::path configs = fs::path(VITRUVIA_SOURCE_DIR) / "configs";
            fs::create_directories(folder / "configs/scenes");
            fs::copy(configs / "motions", folder / "configs/motions");
            fs::copy_file(configs / "scenes/small.json", folder / "configs/scenes/small.json");
            fs::copy_file(configs / "skeletons/human.json", folder / "configs/human.json");
          },
          {"configs/scenes/small.json", "configs/human.json"},
          ByNameWith(kConfigRules),
          [](const fs::path& folder) -> Reading {
            return {
                WriteSettings(ReadScene(folder / "configs/scenes/small.json")).dump() +
                    WriteSettings(dynamic::ReadSkeletonFile(folder / "configs/human.json")).dump(),
                {}};
          }};
}

}  // namespace

std::vector<MutatedFormat> MutatedFormats() {
  return {Bvh(),
          AsfAmc(),
          Keyframes(),
          Ply(),
          BinaryPly("ply_little_endian", {}),
          BinaryPly("ply_big_endian", BigEndianPly),
          Off(),
          ImportedMeshes(),
          ImportedEval(),
          TextPcd(),
          ListOfDepthFiles(),
          Sequence(),
          Estimate(),
          Records(),
          StoredShapeSpace(),
          Configs()};
}

}  // namespace vitruvia
