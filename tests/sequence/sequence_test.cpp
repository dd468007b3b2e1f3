#include "sequence/sequence.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"
#include "core/files.h"
#include "core/worker_team.h"
#include "geometry/depth_png.h"
#include "geometry/mask_png.h"
#include "math/rigid.h"
#include "math/rotation.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kFrames = 3;

SequenceInfo SmallInfo() {
  SequenceInfo info;
  info.camera = {16, 12, 20.5, 21.5, 7.25, 5.75};
  info.depth_unit_m = 0.0005;
  info.fps = 25.0;
  info.frames = kFrames;
  info.joints = {"neck", "left_hip"};
  info.provenance = {{"made_by", "a test"}};
  return info;
}

DepthImage SmallDepth(int frame) {
  DepthImage depth(16, 12);
  for (int v = 0; v < 12; ++v) {
    for (int u = 0; u < 16; ++u) depth(u, v) = 0.001f * static_cast<float>(u + 16 * v + frame);
  }
  return depth;
}

std::vector<Vector3f> SmallVertices(const BodyModel& body, int frame) {
  std::vector<Vector3f> vertices = body.rest.vertices;
  for (Vector3f& p : vertices) p += Vector3f(0.1f * static_cast<float>(frame), 0.0f, 2.5f);
  return vertices;
}

JointTruth SmallJoints(int frame) {
  return {{{0.1 * frame, 1.0 / 3.0, 2.5}, {-0.1, 0.9, 2.4}}, {frame != 1, true}};
}

void WriteSmall(const fs::path& folder, const SequenceInfo& info = SmallInfo()) {
  const BodyModel body = TinyBody();
  SequenceWriter writer(folder, info, body, body.rest);
  for (int i = 0; i < info.frames; ++i) {
    writer.Append(SmallDepth(i), SmallVertices(body, i), SmallJoints(i));
  }
  writer.Finish();
}

// Why a sequence is refused.
std::string Refusal(const fs::path& folder) {
  try {
    VerifySequence(folder);
  } catch (const DataError& error) {
    return error.what();
  }
  return "not refused";
}

class Sequence : public testing::Test {
 protected:
  // Replaces a part of a text file.
  void Edit(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = ReadWholeFile(folder_ / name);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << text;
    WriteWholeFile(folder_ / name, text.replace(at, from.size(), to));
  }

  void CutShort(const std::string& name, std::size_t bytes) const {
    const std::string content = ReadWholeFile(folder_ / name);
    WriteWholeFile(folder_ / name, content.substr(0, content.size() - bytes));
  }

  TemporaryFolder temporary_;
  fs::path root_ = temporary_.path(), folder_ = root_ / "walk";
};

TEST_F(Sequence, ReadsBackWhatWasWritten) {
  WriteSmall(folder_);
  VerifySequence(folder_);
  const BodyModel body = TinyBody();
  const SequenceReader reader(folder_);
  EXPECT_EQ(WriteSettings(reader.info().camera), WriteSettings(SmallInfo().camera));
  EXPECT_EQ(reader.info().depth_unit_m, 0.0005);
  EXPECT_EQ(reader.info().fps, 25.0);
  EXPECT_EQ(reader.info().frames, kFrames);
  EXPECT_EQ(reader.info().joints, SmallInfo().joints);
  EXPECT_EQ(reader.info().provenance, SmallInfo().provenance);
  EXPECT_EQ(reader.true_rest_mesh().vertices, body.rest.vertices);
  EXPECT_EQ(reader.true_rest_mesh().triangles, body.rest.triangles);
  EXPECT_EQ(reader.subject().rest.triangles, body.rest.triangles);
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(reader.ReadTrueVertices(i), SmallVertices(body, i));
    EXPECT_EQ(reader.true_joints(i).positions, SmallJoints(i).positions);
    EXPECT_EQ(reader.true_joints(i).visible, SmallJoints(i).visible);
    const DepthImage depth = reader.ReadDepth(i), expected = SmallDepth(i);
    for (std::size_t p = 0; p < expected.pixels().size(); ++p) {
      ASSERT_NEAR(depth.pixels()[p], expected.pixels()[p], 1e-6);
    }
  }
}

TEST_F(Sequence, HidesWhatTheMaskCallsBackground) {
  WriteSmall(folder_);
  fs::create_directory(folder_ / "mask");
  MaskImage mask(16, 12, 255);
  mask(5, 7) = 0;
  mask(6, 7) = 1;
  mask(7, 7) = kForeignDepthMask;  // inside of the outline, with the depth of the background
  for (int i = 0; i < kFrames; ++i) {
    WriteMaskPng(folder_ / fmt::format("mask/00000{}.png", i), mask);
  }
  const DepthImage depth = SequenceReader(folder_).ReadDepth(1);
  EXPECT_EQ(depth(5, 7), 0.0f);
  EXPECT_EQ(depth(7, 7), 0.0f);
  EXPECT_NEAR(depth(6, 7), SmallDepth(1)(6, 7), 1e-6);
  EXPECT_NEAR(depth(4, 7), SmallDepth(1)(4, 7), 1e-6);

  fs::remove(folder_ / "mask/000002.png");
  EXPECT_THAT(Refusal(folder_), AllOf(HasSubstr("mask/000002.png"), HasSubstr("is missing")));
  WriteDepthPng(folder_ / "mask/000002.png", SmallDepth(2), 0.001);
  EXPECT_THAT(Refusal(folder_), AllOf(HasSubstr("mask/000002.png"), HasSubstr("8 bits")));
}

// A surface whose triangles differ from frame to frame.
TriangleMesh OwnSurface(int frame) {
  TriangleMesh mesh = TinyBody().rest;
  for (Vector3f& p : mesh.vertices) p += Vector3f(0.0f, 0.0f, 2.5f);
  mesh.triangles.resize(mesh.triangles.size() - static_cast<std::size_t>(frame));
  return mesh;
}

SequenceInfo OwnSurfaceInfo() {
  SequenceInfo info = SmallInfo();
  info.joints.clear();
  info.surface = false;
  info.subject = false;
  info.own_surfaces = true;
  info.views = {
      {"side", {8, 6, 10.0, 10.0, 3.5, 2.5}, {ExpSo3<double>({0.0, 1.5, 0.0}), {1, 0, 2}}}};
  info.start_pose = {{"left_knee", {0.1, 0.5, 2.4}}, {"head", {0.0, -0.5, 2.5}}};
  info.start_pose_accuracy_m = 0.03;
  return info;
}

void WriteOwnSurfaces(const fs::path& folder) {
  SequenceWriter writer(folder, OwnSurfaceInfo(), std::nullopt);
  for (int i = 0; i < kFrames; ++i) {
    writer.Append(SmallDepth(i), OwnSurface(i), JointTruth());
    writer.WriteViewDepth(0, i, DepthImage(8, 6, 1.5f + static_cast<float>(i)));
  }
  writer.Finish();
}

TEST_F(Sequence, IsOfVersion1UnlessItSaysMore) {
  WriteSmall(folder_);
  EXPECT_EQ(ReadJsonFile(folder_ / "sequence.json").at("version"), 1);
  WriteOwnSurfaces(root_ / "own");
  EXPECT_EQ(ReadJsonFile(root_ / "own/sequence.json").at("version"), 2);
}

TEST_F(Sequence, Version2ReadsBackWhatWasWritten) {
  WriteOwnSurfaces(folder_);
  VerifySequence(folder_);
  const SequenceReader reader(folder_);
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(reader.ReadTrueSurface(i).vertices, OwnSurface(i).vertices);
    EXPECT_EQ(reader.ReadTrueSurface(i).triangles, OwnSurface(i).triangles);
    EXPECT_NEAR(reader.ReadViewDepth(0, i)(3, 2), 1.5f + static_cast<float>(i), 1e-6);
  }
  const OtherView &view = reader.info().views.at(0), expected = OwnSurfaceInfo().views[0];
  EXPECT_EQ(view.name, "side");
  EXPECT_TRUE(view.view_from_camera.rotation.isApprox(expected.view_from_camera.rotation));
  EXPECT_EQ(view.view_from_camera.translation, expected.view_from_camera.translation);
  ASSERT_EQ(reader.info().start_pose.size(), 2u);
  EXPECT_EQ(reader.info().start_pose[0].joint, "left_knee");
  EXPECT_EQ(reader.info().start_pose[1].position, OwnSurfaceInfo().start_pose[1].position);
  EXPECT_EQ(reader.info().start_pose_accuracy_m, 0.03);
}

TEST_F(Sequence, DamagedVersion2IsNamed) {
  WriteOwnSurfaces(folder_);
  const std::string header = ReadWholeFile(folder_ / "sequence.json");
  Edit("sequence.json", "left_knee", "third_knee");
  EXPECT_THAT(Refusal(folder_), HasSubstr("no joint \"third_knee\""));
  WriteWholeFile(folder_ / "sequence.json", header);
  Edit("sequence.json", "\"version\": 2", "\"version\": 3");
  EXPECT_THAT(Refusal(folder_), HasSubstr("newer version"));
  WriteWholeFile(folder_ / "sequence.json", header);
  CutShort("truth/surfaces/000001.ply", 5);
  EXPECT_THAT(Refusal(folder_), HasSubstr("surfaces/000001.ply"));
  fs::remove(folder_ / "truth/surfaces/000001.ply");
  EXPECT_THAT(Refusal(folder_), HasSubstr("frame 1 is missing"));
  fs::remove_all(folder_ / "views");
  EXPECT_THAT(Refusal(folder_), HasSubstr("folder is missing"));
}

TEST_F(Sequence, MasksAndPreviewAreWrittenWithTheFrames) {
  SequenceInfo info = SmallInfo();
  info.joints.clear();
  info.surface = info.subject = false;
  {
    SequenceWriter writer(folder_, info, std::nullopt);
    WorkerTeam team(2);
    writer.Append({SmallDepth(0), SmallDepth(1), SmallDepth(2)}, team);
    MaskImage mask(16, 12);
    mask(3, 4) = 255;
    for (int i = 0; i < kFrames; ++i) writer.WriteMask(i, mask);
    writer.WriteEmptyRoom(0, SmallDepth(0));
    writer.WritePreview("png");
    writer.Finish();
  }
  const SequenceReader reader(folder_);
  ASSERT_TRUE(reader.has_masks());
  EXPECT_EQ(reader.ReadMask(1)(3, 4), 255);
  EXPECT_EQ(reader.ReadDepth(2)(4, 4), 0.0f);
  EXPECT_NEAR(reader.ReadDepthWithRoom(2)(4, 4), SmallDepth(2)(4, 4), 1e-6);
  EXPECT_NEAR(reader.ReadDepth(2)(3, 4), SmallDepth(2)(3, 4), 1e-6);
  EXPECT_TRUE(fs::exists(folder_ / "empty_room/000000.png"));
}

TEST_F(Sequence, HashKnowsEveryByteButTheProvenance) {
  WriteSmall(folder_);
  const std::string original = SequenceReader(folder_).hash();
  EXPECT_EQ(original.size(), 16u);
  WriteSmall(root_ / "again");
  EXPECT_EQ(SequenceReader(root_ / "again").hash(), original);

  Edit("sequence.json", "a test", "another");
  EXPECT_EQ(SequenceReader(folder_).hash(), original);
  Edit("sequence.json", "7.25", "7.26");
  EXPECT_NE(SequenceReader(folder_).hash(), original);
  Edit("sequence.json", "7.26", "7.25");
  EXPECT_EQ(SequenceReader(folder_).hash(), original);

  const auto differs_after = [&](const std::string& name, const auto& write) {
    const std::string before = ReadWholeFile(folder_ / name);
    write(folder_ / name);
    const std::string hash = SequenceReader(folder_).hash();
    WriteWholeFile(folder_ / name, before);
    return hash != original;
  };
  EXPECT_TRUE(differs_after("depth/000001.png", [](const fs::path& file) {
    DepthImage depth = SmallDepth(1);
    depth(3, 3) += 0.001f;
    WriteDepthPng(file, depth, 0.0005);
  }));
  EXPECT_TRUE(differs_after("truth/vertices.bin", [](const fs::path& file) {
    std::string content = ReadWholeFile(file);
    content[40] = static_cast<char>(content[40] ^ 1);
    WriteWholeFile(file, content);
  }));
  EXPECT_EQ(SequenceReader(folder_).hash(), original);
}

TEST_F(Sequence, AppearsWholeOrNotAtAll) {
  const BodyModel body = TinyBody();
  {
    SequenceWriter writer(folder_, SmallInfo(), body, body.rest);
    writer.Append(SmallDepth(0), SmallVertices(body, 0), SmallJoints(0));
    EXPECT_THROW(writer.Finish(), std::logic_error);
    EXPECT_FALSE(fs::exists(folder_));
  }
  EXPECT_TRUE(fs::is_empty(root_));

  WriteSmall(folder_);
  const std::string hash = SequenceReader(folder_).hash();
  { const SequenceWriter abandoned(folder_, SmallInfo(), body, body.rest); }
  EXPECT_EQ(SequenceReader(folder_).hash(), hash);
}

TEST_F(Sequence, WriterNotesWhatCameToLightLater) {
  const BodyModel body = TinyBody();
  SequenceWriter writer(folder_, SmallInfo(), body, body.rest);
  for (int i = 0; i < kFrames; ++i) {
    writer.Append(SmallDepth(i), SmallVertices(body, i), SmallJoints(i));
  }
  writer.Note("warnings", {"it rained"});
  writer.Finish();
  const nlohmann::json provenance = SequenceReader(folder_).info().provenance;
  EXPECT_EQ(provenance["warnings"][0], "it rained");
  EXPECT_EQ(provenance["made_by"], "a test");
}

TEST_F(Sequence, WriterRefusesWhatDoesNotFit) {
  const BodyModel body = TinyBody();
  SequenceInfo info = SmallInfo();
  info.frames = 0;
  EXPECT_THROW(SequenceWriter(folder_, info, body, body.rest), std::invalid_argument);
  info = SmallInfo();
  info.camera.width = 0;
  EXPECT_THROW(SequenceWriter(folder_, info, body, body.rest), std::invalid_argument);
  info = SmallInfo();
  info.joints[1] = "neck";
  EXPECT_THROW(SequenceWriter(folder_, info, body, body.rest), std::invalid_argument);

  SequenceWriter writer(folder_, SmallInfo(), body, body.rest);
  const std::vector<Vector3f> vertices = SmallVertices(body, 0);
  EXPECT_THROW(writer.Append(DepthImage(16, 13), vertices, SmallJoints(0)), std::invalid_argument);
  EXPECT_THROW(writer.Append(SmallDepth(0), std::vector<Vector3f>{}, SmallJoints(0)),
               std::invalid_argument);
  EXPECT_THROW(writer.Append(SmallDepth(0), vertices, JointTruth{}), std::invalid_argument);
  std::vector<Vector3f> broken = vertices;
  broken[7].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(writer.Append(SmallDepth(0), broken, SmallJoints(0)), std::invalid_argument);
}

TEST_F(Sequence, WriterSaysThatAFolderCannotBeWritten) {
  const BodyModel body = TinyBody();
  WriteWholeFile(root_ / "file", "in the way");
  EXPECT_THROW(SequenceWriter(root_ / "file/walk", SmallInfo(), body, body.rest), RunError);
  EXPECT_THROW(SequenceWriter(root_ / "file", SmallInfo(), body, body.rest), RunError);
}

// --- Damage, each kind refused with its reason ---------------------------------------------------

TEST_F(Sequence, RefusesAFolderThatIsNone) {
  EXPECT_THAT(Refusal(root_ / "nowhere"), AllOf(HasSubstr("nowhere"), HasSubstr("is no folder")));
  EXPECT_THAT(Refusal(root_), AllOf(HasSubstr("sequence.json"), HasSubstr("cannot be opened")));
}

TEST_F(Sequence, RefusesWrongHeaders) {
  const auto refusal_with = [&](const char* from, const char* to) {
    WriteSmall(folder_);
    Edit("sequence.json", from, to);
    return Refusal(folder_);
  };
  EXPECT_THAT(
      refusal_with("depth_unit_m", "depth_units"),
      AllOf(HasSubstr("sequence.json: depth_units"), HasSubstr("did you mean \"depth_unit_m\"")));
  EXPECT_THAT(refusal_with("\"frames\": 3", "\"frames\": 0"),
              AllOf(HasSubstr("frames"), HasSubstr("got 0")));
  EXPECT_THAT(refusal_with("\"width\": 16", "\"width\": 0"),
              AllOf(HasSubstr("camera.width"), HasSubstr("got 0")));
  EXPECT_THAT(refusal_with("\"fx\": 20.5,", ""), HasSubstr("camera.fx: missing"));
  EXPECT_THAT(refusal_with("\"fx\": 20.5", "\"fx\": \"20.5\""), HasSubstr("expected a number"));
  EXPECT_THAT(refusal_with("0.0005", "-1"), HasSubstr("depth_unit_m"));
  EXPECT_THAT(refusal_with("\"version\": 1", "\"version\": 3"),
              HasSubstr("version 3: a newer version of vitruvia wrote the file; this one reads 2"));
  EXPECT_THAT(refusal_with("vitruvia-sequence", "video"),
              HasSubstr("format: expected \"vitruvia-sequence\", got \"video\""));
  EXPECT_THAT(refusal_with("\"left_hip\"", "\"neck\""), HasSubstr("\"neck\" stands twice"));
  EXPECT_THAT(refusal_with("{", "["), HasSubstr("not valid JSON"));
}

TEST_F(Sequence, RefusesDamagedFrames) {
  const auto refusal_after = [&](const auto& damage) {
    WriteSmall(folder_);
    damage();
    return Refusal(folder_);
  };
  EXPECT_THAT(refusal_after([&] { fs::remove(folder_ / "depth/000001.png"); }),
              AllOf(HasSubstr("depth/000001.png"), HasSubstr("frame 1 is missing")));
  EXPECT_THAT(refusal_after([&] {
                fs::copy_file(folder_ / "depth/000001.png", folder_ / "depth/000003.png");
              }),
              AllOf(HasSubstr("depth/000003.png"), HasSubstr("not part of the 3 frames")));
  EXPECT_THAT(refusal_after([&] { CutShort("depth/000002.png", 20); }),
              AllOf(HasSubstr("depth/000002.png"), HasSubstr("cut short")));
  EXPECT_THAT(refusal_after([&] { WriteWholeFile(folder_ / "depth/000000.png", ""); }),
              HasSubstr("is not a PNG file"));
  EXPECT_THAT(refusal_after([&] {
                WriteDepthPng(folder_ / "depth/000002.png", DepthImage(16, 11, 1.0f), 0.001);
              }),
              AllOf(HasSubstr("depth/000002.png"), HasSubstr("expected 16×12 pixels")));
  EXPECT_THAT(refusal_after([&] { fs::remove_all(folder_ / "depth"); }),
              AllOf(HasSubstr("depth"), HasSubstr("folder is missing")));
}

TEST_F(Sequence, RefusesDamagedTruth) {
  const auto refusal_after = [&](const auto& damage) {
    WriteSmall(folder_);
    damage();
    return Refusal(folder_);
  };
  EXPECT_THAT(refusal_after([&] { CutShort("truth/vertices.bin", 4); }),
              AllOf(HasSubstr("vertices.bin"), HasSubstr("3 frames")));
  EXPECT_THAT(refusal_after(
                  [&] { std::ofstream(folder_ / "truth/vertices.bin", std::ios::app) << "more"; }),
              AllOf(HasSubstr("vertices.bin"), HasSubstr("expected")));
  EXPECT_THAT(refusal_after([&] { fs::remove(folder_ / "truth/vertices.bin"); }),
              AllOf(HasSubstr("vertices.bin"), HasSubstr("cannot be opened")));
  EXPECT_THAT(refusal_after([&] {
                std::string content = ReadWholeFile(folder_ / "truth/vertices.bin");
                const float nan = std::numeric_limits<float>::quiet_NaN();
                const std::size_t frame_bytes = content.size() / kFrames;
                std::copy_n(reinterpret_cast<const char*>(&nan), sizeof(nan),
                            content.begin() + static_cast<std::ptrdiff_t>(frame_bytes + 5 * 12));
                WriteWholeFile(folder_ / "truth/vertices.bin", content);
              }),
              AllOf(HasSubstr("frame 1, vertex 5 is not finite")));
  EXPECT_THAT(refusal_after([&] { CutShort("truth/mesh.ply", 30); }), HasSubstr("mesh.ply"));
  // Another mesh than the vertices are of.
  EXPECT_THAT(refusal_after([&] {
                const BodyModel finer = TinyBody(2);
                SequenceInfo info = SmallInfo();
                info.frames = 1;
                SequenceWriter writer(root_ / "finer", info, finer, finer.rest);
                writer.Append(SmallDepth(0), SmallVertices(finer, 0), SmallJoints(0));
                writer.Finish();
                fs::copy_file(root_ / "finer/truth/mesh.ply", folder_ / "truth/mesh.ply",
                              fs::copy_options::overwrite_existing);
              }),
              AllOf(HasSubstr("vertices.bin"), HasSubstr("vertices of mesh.ply")));
}

TEST_F(Sequence, RefusesDamagedJoints) {
  const auto refusal_with = [&](const char* from, const char* to) {
    WriteSmall(folder_);
    Edit("truth/joints.json", from, to);
    return Refusal(folder_);
  };
  EXPECT_THAT(refusal_with("[-0.1,0.9,2.4]", "[-0.1,0.9]"),
              HasSubstr("joints.json: frames[0].positions[1]: expected three numbers"));
  EXPECT_THAT(refusal_with("[-0.1,0.9,2.4]", "[-0.1,0.9,null]"), HasSubstr("three numbers"));
  EXPECT_THAT(refusal_with(",[-0.1,0.9,2.4]", ""),
              AllOf(HasSubstr("frames[0].positions"), HasSubstr("expected 2 items, got 1")));
  EXPECT_THAT(refusal_with("[true,true]", "[true]"), HasSubstr("frames[0].visible"));
  EXPECT_THAT(refusal_with("[true,true]", "[1,0]"), HasSubstr("true or false"));
  EXPECT_THAT(refusal_with("\"neck\"", "\"knee\""),
              HasSubstr("joints: expected \"neck\", \"left_hip\" as in sequence.json, got "
                        "\"knee\", \"left_hip\""));
  EXPECT_THAT(refusal_with("\"frames\"", "\"pictures\""), HasSubstr("pictures: unknown key"));

  WriteSmall(folder_);
  fs::remove(folder_ / "truth/joints.json");
  EXPECT_THAT(Refusal(folder_), HasSubstr("joints.json"));
}

TEST_F(Sequence, RefusesADamagedSubject) {
  for (const char* name : {"subject/mesh.ply", "subject/subject.json", "subject/weights.bin"}) {
    WriteSmall(folder_);
    CutShort(name, 25);
    EXPECT_THAT(Refusal(folder_), HasSubstr(name));
    fs::remove(folder_ / name);
    EXPECT_THAT(Refusal(folder_), HasSubstr(name));
  }
}

TEST_F(Sequence, ReaderRefusesFramesThatAreNotThere) {
  WriteSmall(folder_);
  const SequenceReader reader(folder_);
  EXPECT_THROW(reader.ReadDepth(kFrames), std::invalid_argument);
  EXPECT_THROW(reader.true_joints(-1), std::invalid_argument);
  EXPECT_THROW(reader.ReadTrueVertices(kFrames), std::invalid_argument);
}

// A sequence without a surface; its subject and its joints as `info` says.
void WritePartial(const fs::path& folder, const SequenceInfo& info) {
  std::optional<BodyModel> subject;
  if (info.subject) subject = TinyBody();
  SequenceWriter writer(folder, info, subject);
  for (int i = 0; i < info.frames; ++i) {
    JointTruth joints = info.joints.empty() ? JointTruth{} : SmallJoints(i);
    if (i == 2 && !info.joints.empty()) {
      joints.known = {false, true};
      joints.visible = {false, true};
      joints.positions[0].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    writer.Append(SmallDepth(i), joints);
  }
  writer.Finish();
}

SequenceInfo PartialInfo(bool subject) {
  SequenceInfo info = SmallInfo();
  info.surface = false;
  info.subject = subject;
  return info;
}

TEST_F(Sequence, MayCarryJointsOnlyAndOfTheseOnlyTheKnown) {
  WritePartial(folder_, PartialInfo(false));
  VerifySequence(folder_);
  const SequenceReader reader(folder_);
  EXPECT_FALSE(reader.info().surface);
  EXPECT_FALSE(reader.info().subject);
  EXPECT_FALSE(fs::exists(folder_ / "subject"));
  EXPECT_FALSE(fs::exists(folder_ / "truth/mesh.ply"));
  EXPECT_TRUE(reader.true_joints(1).Knows(0));
  EXPECT_EQ(reader.true_joints(1).positions, SmallJoints(1).positions);
  EXPECT_FALSE(reader.true_joints(2).Knows(0));
  EXPECT_TRUE(reader.true_joints(2).Knows(1));
  EXPECT_FALSE(reader.true_joints(2).visible[0]);
  EXPECT_EQ(reader.true_joints(2).positions[1], SmallJoints(2).positions[1]);
  EXPECT_THROW(reader.ReadTrueVertices(0), std::invalid_argument);
  EXPECT_THROW(reader.true_rest_mesh(), std::invalid_argument);
  try {
    reader.subject();
    FAIL();
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(), HasSubstr("walk: the sequence has no subject for a tracker; name"));
  }
}

TEST_F(Sequence, MayCarryNoTruthAtAll) {
  SequenceInfo info = PartialInfo(true);
  info.joints.clear();
  WritePartial(folder_, info);
  VerifySequence(folder_);
  const SequenceReader reader(folder_);
  EXPECT_FALSE(fs::exists(folder_ / "truth"));
  EXPECT_EQ(reader.subject().rest.triangles, TinyBody().rest.triangles);
  EXPECT_THROW(reader.true_joints(0), std::invalid_argument);
}

TEST_F(Sequence, LostTruthDoesNotPassForNone) {
  WriteSmall(folder_);
  fs::remove(folder_ / "truth/mesh.ply");
  fs::remove(folder_ / "truth/vertices.bin");
  EXPECT_THAT(Refusal(folder_), HasSubstr("truth/mesh.ply"));
  WriteSmall(folder_);
  fs::remove_all(folder_ / "subject");
  EXPECT_THAT(Refusal(folder_), HasSubstr("walk/subject: folder is missing"));
}

TEST_F(Sequence, TruthThatOughtNotToBeThereIsRefused) {
  WritePartial(folder_, PartialInfo(true));
  WriteWholeFile(folder_ / "truth/vertices.bin", "");
  EXPECT_THAT(Refusal(folder_),
              HasSubstr("truth/vertices.bin: is there, but in sequence.json surface is false"));
  WritePartial(folder_, PartialInfo(true));
  Edit("sequence.json", "\"surface\": false", "\"surface\": false,\n\"subject\": false");
  EXPECT_THAT(Refusal(folder_),
              HasSubstr("walk/subject: is there, but sequence.json says that there is none"));
}

TEST_F(Sequence, CompleteSequencesSayNothingNewAndKeepTheirHash) {
  WriteSmall(folder_);
  const Json header = ReadJsonFile(folder_ / "sequence.json");
  EXPECT_FALSE(header.contains("surface"));
  EXPECT_FALSE(header.contains("subject"));
  const std::string hash = SequenceReader(folder_).hash();
  Edit("sequence.json", "\"frames\": 3", "\"frames\": 3, \"surface\": true, \"subject\": true");
  EXPECT_EQ(SequenceReader(folder_).hash(), hash);
}

TEST_F(Sequence, AnUnknownJointIsNullAndNotVisible) {
  WritePartial(folder_, PartialInfo(false));
  Json joints = ReadJsonFile(folder_ / "truth/joints.json");
  EXPECT_TRUE(joints["frames"][2]["positions"][0].is_null());
  joints["frames"][2]["visible"][0] = true;
  WriteWholeFile(folder_ / "truth/joints.json", joints.dump());
  EXPECT_THAT(Refusal(folder_), HasSubstr("frames[2]: joint \"neck\" is visible, but its position "
                                          "is null"));
}

TEST_F(Sequence, WriterRefusesPartsThatItsHeaderDenies) {
  const BodyModel body = TinyBody();
  EXPECT_THROW(SequenceWriter(folder_, PartialInfo(true), body, body.rest), std::invalid_argument);
  EXPECT_THROW(SequenceWriter(folder_, PartialInfo(true), std::nullopt), std::invalid_argument);
  EXPECT_THROW(SequenceWriter(folder_, SmallInfo(), body), std::invalid_argument);
  SequenceWriter writer(folder_, PartialInfo(true), body);
  EXPECT_THROW(writer.Append(SmallDepth(0), SmallVertices(body, 0), SmallJoints(0)),
               std::invalid_argument);
  JointTruth joints = SmallJoints(0);
  joints.known = {false, true};  // and visible
  EXPECT_THROW(writer.Append(SmallDepth(0), joints), std::invalid_argument);
  joints.known = {true};
  EXPECT_THROW(writer.Append(SmallDepth(0), joints), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia
