#include "methods/dynamic/skeleton_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/json_settings.h"
#include "core/error.h"
#include "dynamic_fixtures.h"

namespace vitruvia::dynamic {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Json TwoJoints() {
  return Json::parse(R"({
    "name": "stick",
    "joints": [
      {"name": "root", "type": "hinge", "parent": "world", "at": "pelvis", "axis": [0, 0, 1],
       "limit_deg": {"lower": -90, "upper": 90}, "bone": "pelvis"},
      {"name": "slide", "type": "prismatic", "parent": "root", "at": "waist", "towards": "chest",
       "limit_m": {"lower": -0.1, "upper": 0.1}, "bone": "abdomen"}
    ]})");
}

// What reading the two joints says after joint `index` was overridden.
std::string MessageOf(int index, const char* overrides) {
  Json json = TwoJoints();
  json["joints"][index] = Merged(json["joints"][index], Json::parse(overrides));
  try {
    ReadSettings<SkeletonFile>(json, {"stick.json", ""});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SkeletonFile, ReadsTheShippedHumans) {
  const SkeletonFile human = HumanSkeleton();
  EXPECT_EQ(human.joints.size(), 47u);
  const SkeletonFile waist_up =
      ReadSkeletonFile(std::string(VITRUVIA_SOURCE_DIR) + "/configs/skeletons/human_waist_up.json");
  EXPECT_EQ(waist_up.joints.size(), 33u);
}

TEST(SkeletonFile, AcceptsJointsInAnyOrder) {
  Json json = TwoJoints();
  std::swap(json["joints"][0], json["joints"][1]);
  const auto file = ReadSettings<SkeletonFile>(json, {"stick.json", ""});
  const KinematicTree tree(file, TinyBody().skeleton);
  EXPECT_EQ(tree.joints()[0].name, "root");
  EXPECT_EQ(tree.joints()[1].parent, 0);
}

TEST(SkeletonFile, RefusesACycle) {
  EXPECT_THAT(MessageOf(0, R"({"parent": "slide"})"),
              AllOf(HasSubstr("stick.json"), HasSubstr("round in a circle: root → slide → root")));
  EXPECT_THAT(MessageOf(1, R"({"parent": "slide"})"), HasSubstr("slide → slide"));
}

TEST(SkeletonFile, RefusesAnUnknownParentAndNamesTheNearest) {
  EXPECT_THAT(MessageOf(1, R"({"parent": "rot"})"),
              HasSubstr("joint \"slide\": there is no parent \"rot\"; did you mean \"root\"?"));
}

TEST(SkeletonFile, RefusesAnAxisWithoutDirection) {
  EXPECT_THAT(MessageOf(0, R"({"axis": [0, 0, 0]})"),
              HasSubstr("joint \"root\": axis: (0, 0, 0) has no direction"));
  EXPECT_THAT(MessageOf(1, R"({"towards": "waist"})"), HasSubstr("names the joint's own place"));
  EXPECT_THAT(MessageOf(1, R"({"axis": [1, 0, 0]})"), HasSubstr("both axis and towards"));
}

TEST(SkeletonFile, RefusesReversedLimitsAndThoseWithoutTheBindPose) {
  EXPECT_THAT(MessageOf(0, R"({"limit_deg": {"lower": 90, "upper": -90}})"),
              HasSubstr("limit_deg: lower 90 is above upper -90"));
  EXPECT_THAT(MessageOf(1, R"({"limit_m": {"lower": 0.05}})"),
              HasSubstr("limit_m: 0.05 … 0.1 does not hold 0, the bind pose"));
}

TEST(SkeletonFile, RefusesNamesAndBonesThatAreTakenOrUnknown) {
  EXPECT_THAT(MessageOf(1, R"({"name": "root"})"), HasSubstr("there are two of that name"));
  EXPECT_THAT(MessageOf(1, R"({"name": "world"})"), HasSubstr("is no name for a joint"));
  EXPECT_THAT(MessageOf(1, R"({"bone": "pelvis"})"),
              HasSubstr("bone \"pelvis\" already moves with \"root\""));
  EXPECT_THAT(MessageOf(1, R"({"bone": "abdomne"})"), HasSubstr("did you mean \"abdomen\"?"));
  EXPECT_THAT(MessageOf(0, R"({"at": "pelvsi"})"), HasSubstr("did you mean \"pelvis\"?"));
  EXPECT_THAT(MessageOf(0, R"({"bone": ""})"), HasSubstr("no joint moves the bone \"pelvis\""));
}

TEST(SkeletonFile, RefusesTheOtherTypesLimits) {
  EXPECT_THAT(MessageOf(0, R"({"limit_m": {"lower": 0, "upper": 1}})"), HasSubstr("unknown key"));
}

}  // namespace
}  // namespace vitruvia::dynamic
