#include "reports/pictures/pictures.h"

#include <gmock/gmock.h>

#include "core/files.h"
#include "geometry/zbuffer.h"
#include "reports/drawing/color_maps.h"
#include "reports/pictures/drawn_before.h"
#include "reports/pictures/mesh_view.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"
#include "support/tiny_body.h"

namespace vitruvia {
namespace {

constexpr std::size_t kErrorPicture = 5, kErrorFromTheSide = 6;

bool IsWhite(const ColorPixel& p) { return p[0] == 255 && p[1] == 255 && p[2] == 255; }

// Light scales a colour, its hue stays; on the outline it is mixed with the white paper.
bool IsNoRedderThan(const ColorPixel& pixel, const Color& color) {
  constexpr double kRounding = 0.04;
  for (std::size_t c = 1; c < 3; ++c) {
    const double least = static_cast<double>(color[c]) / color[0] - kRounding;
    if (static_cast<double>(pixel[c]) / pixel[0] < least) return false;
  }
  return true;
}

TEST(Pictures, ErrorMapOfTheTruthIsPaleAllOver) {
  const TemporaryFolder root;
  const ReportedExperiment experiment = ReadExperiment(WriteSyntheticExperiment(root.path()));
  const std::vector<RunPictures> runs = MakePictures(experiment, {});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1].run_id, kExactRun);
  for (const PictureStrip& strip : runs[1].strips) {
    EXPECT_EQ(strip.error_max_m, 0.0);
    for (const std::size_t picture : {kErrorPicture, kErrorFromTheSide}) {
      int body_pixels = 0;
      for (const ColorPixel& pixel : strip.pictures[picture].image.pixels()) {
        if (IsWhite(pixel)) continue;
        ++body_pixels;
        ASSERT_TRUE(IsNoRedderThan(pixel, ErrorColor(0.0)))
            << int{pixel[0]} << " " << int{pixel[1]} << " " << int{pixel[2]};
      }
      EXPECT_GT(body_pixels, kPictureSize * kPictureSize / 20);
    }
  }
  // The waving run is off at the left forearm: dark there, pale at the feet.
  const PictureStrip& strip = runs[0].strips[1];
  EXPECT_EQ(strip.frame, kPictureFrame);
  EXPECT_GT(strip.error_max_m, 0.005);
  const ColorImage& errors = strip.pictures[kErrorPicture].image;
  int red_above = 0, red_below = 0;
  for (int v = 0; v < kPictureSize; ++v) {
    for (int u = 0; u < kPictureSize; ++u) {
      const ColorPixel& p = errors(u, v);
      const bool red = p[0] > 2 * p[2];
      (v < kPictureSize / 2 ? red_above : red_below) += red ? 1 : 0;
    }
  }
  EXPECT_GT(red_above, 50);
  EXPECT_EQ(red_below, 0);
}

RunPictures OneStrip() {
  RunPictures run;
  run.run_id = "run";
  run.titles = PictureTitles();
  PictureStrip strip;
  strip.label = "fit.pair_cutoff_m=0.02,stopping.max_iterations=18";
  for (std::size_t i = 0; i < run.titles.size(); ++i)
    strip.pictures.emplace_back(ColorImage(4, 4, ColorPixel{9, 9, 9, 255}));
  run.strips = {strip, strip};
  return run;
}

std::string SheetOf(const RunPictures& run, const SheetStyle& style) {
  const TemporaryFolder root;
  WritePictureSheet(DrawingWriter({.formats = {FileFormat::kSvg}}), root.path() / "sheet", run,
                    style);
  return ReadWholeFile(root.path() / "sheet.svg");
}

TEST(PictureSheet, NamesNarrowColumnsByLetters) {
  constexpr double kColumn = 238.0, kTextPt = 8.0;  // 84 mm
  const std::string narrow = SheetOf(OneStrip(), {kTextPt, kColumn});
  EXPECT_THAT(narrow, testing::HasSubstr(">g</text>"));
  EXPECT_THAT(narrow, testing::HasSubstr("(a) depth; (b)"));
  const std::string usual = SheetOf(OneStrip(), {});
  EXPECT_THAT(usual, testing::HasSubstr(">depth</text>"));
  EXPECT_THAT(usual, testing::Not(testing::HasSubstr("(a)")));
}

TEST(Pictures, AreTakenWhereTheRunHasFrames) {
  const TemporaryFolder root;
  const ReportedExperiment experiment = ReadExperiment(WriteSyntheticExperiment(root.path()));
  const std::vector<RunPictures> runs = MakePictures(experiment, {});
  for (const RunPictures& run : runs) {
    EXPECT_EQ(run.problem, "");
    ASSERT_EQ(run.strips.size(), 2u);  // frame 999 does not exist
    EXPECT_EQ(run.strips[0].frame, 0);
    EXPECT_EQ(run.strips[0].pictures.size(), PictureTitles().size());
    EXPECT_GE(run.error_scale_m, 0.01);
    EXPECT_LT(run.nearest_m, run.farthest_m);
    EXPECT_EQ(run.error_scale_m, runs[0].error_scale_m);
  }
}

// The z-buffer holds the pinhole camera; the view must cover the same pixels.
TEST(MeshView, SeesWhatThePinholeCameraSees) {
  const BodyModel body = TinyBody(2);
  std::vector<Vector3f> posed;
  for (const Vector3f& v : body.rest.vertices) {
    posed.emplace_back(v.x() + 0.2f, 1.0f - v.y(), 2.5f - v.z());
  }
  const PinholeCamera camera{160, 120, 130.0, 140.0, 70.0, 55.0};
  ZBuffer zbuffer(camera);
  const DepthImage& depth = zbuffer.Render(posed, body.rest.triangles);
  MeshView view(camera.width, camera.height);
  const ColorImage image =
      view.Draw(camera, {0.0, 0.0, 160.0, 120.0}, {{&posed, &body.rest.triangles, {kTruthColor}}});
  int inside = 0, wrong = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int opacity = image(u, v)[3];  // between, the outline runs through the pixel
      const bool in_depth = depth(u, v) > 0.0f;
      inside += opacity == 255 ? 1 : 0;
      wrong += (opacity == 255 && !in_depth) || (opacity == 0 && in_depth) ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 1500);
  EXPECT_EQ(wrong, 0);
}

TEST(MeshView, NearerSurfaceHidesTheFarther) {
  const std::vector<Vector3f> near{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}};
  const std::vector<Vector3f> far{{-2, -2, 3}, {2, -2, 3}, {0, 2, 3}};
  const std::vector<Triangle> triangle{{0, 2, 1}};
  const PinholeCamera camera{40, 40, 40.0, 40.0, 19.5, 19.5};
  MeshView view(40, 40);
  for (const bool near_first : {true, false}) {
    const ShadedMesh a{&near, &triangle, {Color{255, 0, 0}}},
        b{&far, &triangle, {Color{0, 0, 255}}};
    const ColorImage image =
        view.Draw(camera, {0, 0, 40, 40}, near_first ? std::vector{a, b} : std::vector{b, a});
    EXPECT_GT(image(20, 20)[0], 100);
    EXPECT_LT(image(20, 20)[2], 20);
  }
}

TEST(ErrorColor, DarkensSteadily) {
  double last = 1e9;
  for (int i = 0; i <= 20; ++i) {
    const Color c = ErrorColor(i / 20.0);
    const double lightness = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_LT(lightness, last);
    last = lightness;
  }
  EXPECT_EQ(ErrorColor(1.0), ErrorColor(7.0));
}

}  // namespace
}  // namespace vitruvia
