// A small sequence that is right, and what is said of it when one of its parts is not.
#include "verification/verification.h"

#include <algorithm>
#include <functional>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "config/json_settings.h"
#include "core/files.h"
#include "geometry/depth_png.h"
#include "geometry/grey_png.h"
#include "geometry/mesh_io.h"
#include "support/small_recording.h"
#include "support/temporary_folder.h"
#include "verification/checks.h"
#include "verification/rest_mesh_check.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Verification : public testing::Test {
 protected:
  Verification() { recording_.Write(folder_); }

  Findings Found() const {
    return FindInconsistencies(SequenceReader(folder_), FrameSelection::kAll);
  }

  void Expect(Severity severity, const std::vector<std::string>& words) const {
    const Findings findings = Found();
    const auto found = std::find_if(findings.begin(), findings.end(),
                                    [&](const Finding& f) { return f.severity == severity; });
    ASSERT_NE(found, findings.end()) << findings.size() << " findings of another severity";
    for (const std::string& word : words) EXPECT_THAT(found->text, HasSubstr(word));
  }

  void Edit(const std::string& file, const std::function<void(Json&)>& change) const {
    Json json = ReadJsonFile(folder_ / file);
    change(json);
    WriteWholeFile(folder_ / file, json.dump());
  }

  // Every true joint, by frame and place in the list.
  void EditJoints(const std::function<Vector3d(const Vector3d&, int frame)>& change) const {
    Edit("truth/joints.json", [&](Json& json) {
      for (std::size_t i = 0; i < json["frames"].size(); ++i) {
        for (Json& position : json["frames"][i]["positions"]) {
          const Vector3d place(position[0].get<double>(), position[1].get<double>(),
                               position[2].get<double>());
          const Vector3d moved = change(place, static_cast<int>(i));
          position = Json::array({moved.x(), moved.y(), moved.z()});
        }
      }
    });
  }

  void EditVertices(const std::function<Vector3f(const Vector3f&)>& change) const {
    std::string bytes;
    for (int i = 0; i < recording_.frames; ++i) {
      for (const Vector3f& v : recording_.InCamera(i)) {
        const Vector3f moved = change(v);
        bytes.append(reinterpret_cast<const char*>(moved.data()), sizeof moved);
      }
    }
    WriteWholeFile(folder_ / "truth/vertices.bin", bytes);
  }

  void EditDepth(const std::function<DepthImage(const DepthImage&, int frame)>& change) const {
    for (int i = 0; i < recording_.frames; ++i)
      WriteDepthPng(folder_ / fmt::format("depth/{:06}.png", i), change(recording_.Depth(i), i),
                    recording_.depth_unit_m);
  }

  void EditSubject(const std::function<void(BodyModel&)>& change) const {
    BodyModel subject = recording_.body;
    change(subject);
    WriteBodyModel(folder_ / "subject", subject);
  }

  TemporaryFolder temporary_;
  fs::path folder_ = temporary_ / "sequence";
  SmallRecording recording_;
};

void Transform(const Matrix3<double>& map, const Vector3d& shift, BodyModel& body) {
  for (Vector3f& v : body.rest.vertices) v = (map * v.cast<double>() + shift).cast<float>();
  for (Vector3d& joint : body.skeleton.joints) joint = (map * joint + shift).eval();
  for (Vector3d& tip : body.skeleton.tips) tip = (map * tip + shift).eval();
}

TEST_F(Verification, NothingIsFoundWhereAllIsRight) {
  for (const Finding& finding : Found()) ADD_FAILURE() << finding.text;
}

TEST_F(Verification, DepthOfAnotherUnitIsNamedByItsFactor) {
  struct Unit {
    double factor;
    const char* words;
  };
  for (const Unit& unit : {Unit{10.0, "10 times too large"}, Unit{1000.0, "1000 times too large"},
                           Unit{5.0, "5 times too large"}, Unit{0.5, "2 times too small"}}) {
    Edit("sequence.json", [&](Json& json) { json["depth_unit_m"] = 0.001 * unit.factor; });
    Expect(Severity::kError,
           {"depth/: depth and true surface disagree", unit.words, "depth_unit_m"});
  }
}

TEST_F(Verification, DepthOfOneFrameInAnotherUnitIsNamed) {
  EditDepth([](DepthImage depth, int frame) {
    for (float& z : depth.pixels()) z *= frame == 1 ? 2.0f : 1.0f;
    return depth;
  });
  Expect(Severity::kError, {"depth/000001.png", "2 times"});
}

TEST_F(Verification, MirroredAndUpsideDownImagesAreNamed) {
  EditDepth([](const DepthImage& depth, int) {
    DepthImage mirrored = depth;
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) mirrored(u, v) = depth(depth.width() - 1 - u, v);
    }
    return mirrored;
  });
  Expect(Severity::kError, {"mirrored left to right"});
  EditDepth([](const DepthImage& depth, int) {
    DepthImage turned = depth;
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) turned(u, v) = depth(u, depth.height() - 1 - v);
    }
    return turned;
  });
  Expect(Severity::kError, {"upside down"});
}

TEST_F(Verification, SwappedBytesAreNamed) {
  for (int i = 0; i < recording_.frames; ++i) {
    const fs::path file = folder_ / fmt::format("depth/{:06}.png", i);
    cv::Mat raw = ReadGreyPng(file, 16, recording_.camera.width, recording_.camera.height);
    for (auto value = raw.begin<std::uint16_t>(); value != raw.end<std::uint16_t>(); ++value)
      *value = static_cast<std::uint16_t>(*value << 8 | *value >> 8);
    WriteGreyPng(file, raw);
  }
  Expect(Severity::kError, {"the two bytes of each depth value are swapped"});
}

TEST_F(Verification, EmptyConstantAndRepeatedImagesAreNamed) {
  EditDepth([](const DepthImage& depth, int) { return DepthImage(depth.width(), depth.height()); });
  Expect(Severity::kError, {"every image is empty"});
  EditDepth([](DepthImage depth, int) {
    for (float& z : depth.pixels()) z = z > 0.0f ? 2.5f : 0.0f;
    return depth;
  });
  Expect(Severity::kError, {"one value (2.5 m)"});
  EditDepth([this](const DepthImage&, int) { return recording_.Depth(0); });
  Expect(Severity::kError, {"frames 0 to 2 are the same image", "while a true joint moves"});
}

TEST_F(Verification, CamerasOfAnotherResolutionAreNamed) {
  Edit("sequence.json", [](Json& json) {
    for (const char* key : {"fx", "fy"}) json["camera"][key] = 170.0;
    json["camera"]["cx"] = 95.5;
    json["camera"]["cy"] = 71.5;
  });
  Expect(Severity::kError, {"the intrinsics are of another resolution", "fx 85"});
}

TEST(CheckCamera, TheCentreOfAnImageOfAnySizeIsInItsMiddle) {
  const auto says_far = [](const PinholeCamera& camera) {
    const Findings findings = CheckCamera(camera);
    return std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
      return f.text.find("far from the centre") != std::string::npos;
    });
  };
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 120}, {160, 1}, {160, 120}}) {
    PinholeCamera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 142.5;
    camera.cx = (width - 1) / 2.0;
    camera.cy = (height - 1) / 2.0;
    EXPECT_FALSE(says_far(camera)) << width << "×" << height;
    camera.cx += 0.3 * width;
    EXPECT_TRUE(says_far(camera)) << width << "×" << height;
  }
}

TEST_F(Verification, FieldsOfViewThatNoCameraHasAreNamed) {
  for (const double focal : {10.0, 2000.0}) {
    Edit("sequence.json", [&](Json& json) {
      for (const char* key : {"fx", "fy"}) json["camera"][key] = focal;
    });
    const Findings findings = Found();
    ASSERT_FALSE(findings.empty());
    EXPECT_THAT(findings.front().text, HasSubstr("field of view"));
  }
}

TEST_F(Verification, TrueJointsInMillimetresOrOfAnotherPersonAreNamed) {
  EditJoints([](const Vector3d& p, int) -> Vector3d { return 1000.0 * p; });
  Expect(Severity::kError, {"truth/joints.json", "1000 times too large", "millimetres"});
  EditJoints([](const Vector3d& p, int) -> Vector3d { return 1.4 / 1000.0 * p; });
  Expect(Severity::kWarning, {"truth/joints.json", "another person's subject?"});
}

TEST_F(Verification, TrueJointsWithYUpOrSwappedSidesAreNamed) {
  EditJoints([](const Vector3d& p, int) { return Vector3d(p.x(), -p.y(), -p.z()); });
  Expect(Severity::kError, {"truth/joints.json", "y is up"});
  EditJoints([](const Vector3d& p, int) { return Vector3d(p.x(), -p.y(), -p.z()); });
  Edit("truth/joints.json", [](Json& json) {
    for (Json& frame : json["frames"]) {
      const Json positions = frame["positions"];
      for (int bone = 0; bone < kBoneCount; ++bone)
        frame["positions"][static_cast<std::size_t>(bone)] =
            positions[static_cast<std::size_t>(Bones()[static_cast<std::size_t>(bone)].mirror)];
    }
  });
  Expect(Severity::kError, {"left and right are swapped"});
}

TEST_F(Verification, AJumpOfTheTruthIsNamed) {
  EditJoints([](const Vector3d& p, int frame) -> Vector3d {
    return p + (frame == 1 ? Vector3d(0, 0, 0.9) : Vector3d::Zero());
  });
  Expect(Severity::kWarning, {"the body jumps between frames"});
}

TEST_F(Verification, TrueSurfacesOfAnotherUnitOrWithOtherAxesAreNamed) {
  EditVertices([](const Vector3f& v) -> Vector3f { return 1000.0f * v; });
  Expect(Severity::kError, {"truth/vertices.bin", "1000 times too large"});
  EditVertices([](const Vector3f& v) { return Vector3f(v.x(), -v.y(), v.z()); });
  Expect(Severity::kError, {"inside out", "y up instead of down"});
  EditVertices([](const Vector3f& v) { return Vector3f(v.x(), -v.y(), -v.z()); });
  Expect(Severity::kError, {"behind the camera"});
  EditVertices([](const Vector3f& v) { return Vector3f(v.y(), -v.x(), v.z()); });
  Expect(Severity::kError, {"truth/"});
}

TEST_F(Verification, AStrayVertexIsNamed) {
  std::string bytes = ReadWholeFile(folder_ / "truth/vertices.bin");
  const float far_m = 300.0f;
  const std::size_t frame_bytes = recording_.body.rest.vertices.size() * sizeof(Vector3f);
  bytes.replace(frame_bytes + 7 * sizeof(Vector3f), sizeof far_m,
                reinterpret_cast<const char*>(&far_m), sizeof far_m);
  WriteWholeFile(folder_ / "truth/vertices.bin", bytes);
  Expect(Severity::kWarning, {"truth/vertices.bin: frame 1: an edge at vertex"});
}

TEST_F(Verification, ImagesShiftedByAFrameAreNamed) {
  recording_.frames = 6;
  recording_.Write(folder_);
  for (const Finding& finding : Found()) ADD_FAILURE() << finding.text;
  EditDepth([this](const DepthImage&, int frame) { return recording_.Depth(frame - 1); });
  Expect(Severity::kWarning, {"depth/: the images look shifted in time", "of the one before"});
  EditDepth([this](const DepthImage&, int frame) { return recording_.Depth(frame + 1); });
  Expect(Severity::kWarning, {"depth/: the images look shifted in time", "of the one after"});
}

TEST_F(Verification, AnImageOfAnotherMomentIsNamed) {
  recording_.frames = 6;
  recording_.Write(folder_);
  EditDepth([](const DepthImage& depth, int frame) {
    if (frame != 3) return depth;
    constexpr int kAside = 6;
    DepthImage moved(depth.width(), depth.height());
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = kAside; u < depth.width(); ++u) moved(u, v) = depth(u - kAside, v);
    }
    return moved;
  });
  Expect(Severity::kWarning, {"depth/000003.png", "1 of 6 frames", "of another moment"});
}

TEST_F(Verification, AJointNearTheSurfacesPlaceThatIsAnotherOneIsNamed) {
  constexpr auto kWrist = static_cast<std::size_t>(BoneId::kLeftHand);
  constexpr auto kElbow = static_cast<std::size_t>(BoneId::kLeftForearm);
  Edit("truth/joints.json", [&](Json& json) {
    for (Json& frame : json["frames"])
      std::swap(frame["positions"][kWrist], frame["positions"][kElbow]);
  });
  Expect(Severity::kWarning, {"truth/joints.json", "from where truth/vertices.bin carries them"});
}

TEST_F(Verification, VisibleFlagsThatTheImagesContradictAreNamed) {
  recording_.frames = 6;
  recording_.Write(folder_);
  Edit("truth/joints.json", [](Json& json) {
    for (Json& frame : json["frames"]) {
      for (Json& visible : frame["visible"]) visible = !visible.get<bool>();
    }
  });
  Expect(Severity::kWarning, {"\"visible\" disagrees with the images", "marked visible"});
}

TEST_F(Verification, AVertexInNoTriangleIsNamedAndCountsNotForTheSize) {
  recording_.body.rest.vertices.emplace_back(0.0f, 0.0f, 40.0f);
  const Findings findings = CheckRestMesh(recording_.body.rest, SmallRecording().body, "rest.obj");
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_THAT(findings[0].text, HasSubstr("1 of "));
  EXPECT_THAT(findings[0].text, HasSubstr("are in no triangle"));
}

TEST_F(Verification, SubjectsOfAnotherUnitOrSizeAreNamed) {
  const Matrix3<double> as_is = Matrix3<double>::Identity();
  EditSubject([&](BodyModel& body) { Transform(1000.0 * as_is, Vector3d::Zero(), body); });
  Expect(Severity::kError, {"subject/", "1000 times too large", "millimetres"});
  EditSubject([&](BodyModel& body) {
    for (Vector3f& v : body.rest.vertices) v *= 0.5f;
  });
  Expect(Severity::kError, {"subject/mesh.ply", "2 times too small"});
  EditSubject([&](BodyModel& body) {
    for (Vector3d& joint : body.skeleton.joints) joint *= 1000.0;
    for (Vector3d& tip : body.skeleton.tips) tip *= 1000.0;
  });
  Expect(Severity::kError, {"subject/subject.json", "the bones are 1000 times too large"});
  EditSubject([&](BodyModel& body) { body.attributes.height_m = 1.2; });
  Expect(Severity::kError, {"subject/subject.json", "height_m is 1.2"});
}

TEST_F(Verification, SubjectsWithOtherAxesAreNamed) {
  Matrix3<double> z_up;
  z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  EditSubject([&](BodyModel& body) { Transform(z_up, Vector3d::Zero(), body); });
  Expect(Severity::kError, {"subject/", "z up"});
  const Matrix3<double> turned = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  EditSubject([&](BodyModel& body) { Transform(turned, Vector3d::Zero(), body); });
  Expect(Severity::kError, {"subject/", "expected (1, 0, 0), (0, 1, 0) and (0, 0, 1)"});
  EditSubject([&](BodyModel& body) {
    Skeleton swapped = body.skeleton;
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      const auto mirror = static_cast<std::size_t>(Bones()[bone].mirror);
      swapped.joints[bone] = body.skeleton.joints[mirror];
      swapped.tips[bone] = body.skeleton.tips[mirror];
    }
    body.skeleton = swapped;
  });
  Expect(Severity::kError, {"subject/", "left"});
}

TEST_F(Verification, BonesOutsideTheMeshAndAnotherFloorAreNamed) {
  EditSubject([](BodyModel& body) {
    for (Vector3d& joint : body.skeleton.joints) joint.z() += 0.5;
    for (Vector3d& tip : body.skeleton.tips) tip.z() += 0.5;
  });
  Expect(Severity::kError, {"subject/"});
  EditSubject([](BodyModel& body) {
    Transform(Matrix3<double>::Identity(), {0.0, -0.9, 0.0}, body);
  });
  const Findings findings = Found();
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front().text, HasSubstr("subject/"));
}

TEST_F(Verification, ARestMeshInAnotherPlaceIsNamedWithTheWayBack) {
  TriangleMesh moved = recording_.body.rest;
  for (Vector3f& v : moved.vertices) v.x() += 1.0f;
  WriteMesh(folder_ / "truth/mesh.ply", moved);
  Expect(Severity::kError, {"truth/mesh.ply", "(1.00, 0.00, 0.00) m away from the subject"});
}

}  // namespace
}  // namespace vitruvia
