#include "cutout/settings.h"

#include <fmt/format.h>

namespace vitruvia {

void BackgroundSettings::Describe(Fields& f) {
  f.Choice("source", source,
           {{"none", BackgroundSource::kNone},
            {"recording", BackgroundSource::kRecording},
            {"empty_frames", BackgroundSource::kEmptyFrames}},
           {.meaning = "source of the room's depth: none, the recording itself (each pixel must be "
                       "free of the person for some time), or frames without a person",
            .origin = Origin::kInput});
  f.Number("far_share", far_share,
           {.meaning =
                "quantile of a pixel's depths over the recording that is used as the room's depth",
            .min = 0.5,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "a person who moves covers a pixel for less than nine tenths of the time"});
  f.Number(
      "seen_share", seen_share,
      {.meaning = "share of the frames in which a pixel must be measured for its background to be "
                  "known; a pixel measured less often is assumed to lie beyond the sensor's range",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kGuessed});
  f.Number("margin_m", margin_m,
           {.meaning = "distance in front of the background from which a pixel is foreground; the "
                       "sensor's noise increases it",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Integer("samples", samples,
            {.meaning = "frames, evenly spread, from which room and noise are learnt",
             .unit = "frames",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed});
}

void FloorSettings::Describe(Fields& f) {
  f.Flag("remove", remove, {.meaning = "whether a floor is detected and removed"});
  f.Number("tilt_deg", tilt_deg,
           {.meaning = "largest angle between the floor's normal and the image's upright",
            .unit = "deg",
            .min = 0.0,
            .max = 80.0,
            .origin = Origin::kGuessed});
  f.Number("within_m", within_m,
           {.meaning = "distance from the floor's plane up to which a point supports it; the "
                       "sensor's noise increases it",
            .unit = "m",
            .min = 1e-4,
            .max = 0.2,
            .origin = Origin::kGuessed});
  f.Number("least_share", least_share,
           {.meaning = "least share of the points that must lie in a floor's plane",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("below_share", below_share,
           {.meaning = "largest share of the points that may lie below a floor; below a table top "
                       "there are more",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Integer("trials", trials,
            {.meaning = "number of planes through three random points of the lower half that are "
                        "tried; most are rejected at once because they are not level",
             .min = 1,
             .max = 10000000,
             .origin = Origin::kGuessed});
  f.Integer("points", points,
            {.meaning = "number of points of the sampled frames on which a plane is tested",
             .min = 100,
             .max = 10000000,
             .origin = Origin::kGuessed});
  f.Number("margin_m", margin_m,
           {.meaning = "height up to which a point is floor where no background is known; the "
                       "sensor's noise increases it",
            .unit = "m",
            .min = 0.0,
            .max = 0.2,
            .origin = Origin::kGuessed});
  f.Number("certain_m", certain_m,
           {.meaning = "height above which a point is certainly not floor",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("reach_m", reach_m,
           {.meaning = "distance from a point certainly above the floor up to which lower points "
                       "are kept, such as those of a foot",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

void PieceSettings::Describe(Fields& f) {
  f.Number("step_m", step_m,
           {.meaning = "largest difference in depth between neighbouring pixels of one piece; the "
                       "sensor's noise increases it",
            .unit = "m",
            .min = 1e-3,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("gap_m", gap_m,
           {.meaning = "widest gap in a row or column of the image across which a piece continues; "
                       "a gap consists of pixels that are not measured or lie in front, never of "
                       "pixels that lie behind",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("least_area_m2", least_area_m2,
           {.meaning = "area below which a piece is dropped",
            .unit = "m²",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

void PersonSizeSettings::Describe(Fields& f) {
  f.Number("least_height_m", least_height_m,
           {.meaning = "minimum height of a person",
            .unit = "m",
            .min = 0.0,
            .max = 3.0,
            .origin = Origin::kGuessed});
  f.Number("most_height_m", most_height_m,
           {.meaning = "maximum height of a person, with raised arms",
            .unit = "m",
            .min = 0.0,
            .max = 5.0,
            .origin = Origin::kGuessed});
  f.Number("most_width_m", most_width_m,
           {.meaning = "maximum width of a person across the view, with spread arms",
            .unit = "m",
            .min = 0.0,
            .max = 5.0,
            .origin = Origin::kGuessed});
  f.Number("least_area_m2", least_area_m2,
           {.meaning = "minimum visible area of a person",
            .unit = "m²",
            .min = 0.0,
            .max = 2.0,
            .origin = Origin::kGuessed});
}

void TouchingSettings::Describe(Fields& f) {
  f.Number(
      "head_drop_m", head_drop_m,
      {.meaning = "height by which a head must rise above the outline between it and the next head",
       .unit = "m",
       .min = 0.01,
       .max = 1.0,
       .origin = Origin::kGuessed});
  f.Number(
      "least_head_m2", least_head_m2,
      {.meaning =
           "minimum area of a head above the height given by head_drop_m; a raised hand has less",
       .unit = "m²",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kGuessed});
  f.Number("apart_m", apart_m,
           {.meaning = "least horizontal distance between two heads",
            .unit = "m",
            .min = 0.0,
            .max = 2.0,
            .origin = Origin::kGuessed});
  f.Number("least_area_m2", least_area_m2,
           {.meaning = "least area of each part of a divided piece",
            .unit = "m²",
            .min = 0.0,
            .max = 2.0,
            .origin = Origin::kGuessed});
  f.Number("least_height_share", least_height_share,
           {.meaning = "least height of each part of a divided piece, as a share of the piece's",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
}

void FollowingSettings::Describe(Fields& f) {
  f.Number(
      "same_place_m", same_place_m,
      {.meaning = "change of a pixel's depth from frame to frame up to which it shows the same "
                  "person",
       .unit = "m",
       .min = 0.0,
       .max = 2.0,
       .origin = Origin::kGuessed});
  f.Number("claim_share", claim_share,
           {.meaning = "share of a person's last pixels, or of a piece's pixels, that must overlap "
                       "for the piece to be the person's",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("attach_m", attach_m,
           {.meaning = "distance from a person's bounding box up to which a piece too small for a "
                       "person is assigned to that person",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed});
  f.Number("speed_m_s", speed_m_s,
           {.meaning = "maximum speed of a person, which limits how far from the last place a lost "
                       "person is searched",
            .unit = "m/s",
            .min = 0.0,
            .max = 20.0,
            .origin = Origin::kGuessed});
  f.Number("forget_s", forget_s,
           {.meaning = "time after which somebody who is not seen has left",
            .unit = "s",
            .min = 0.0,
            .max = 100.0,
            .origin = Origin::kGuessed});
  f.Number("area_factor", area_factor,
           {.meaning = "factor by which a frame's area must exceed or fall below the median area "
                       "of the frames before and after to be reported as a jump in area",
            .min = 1.0,
            .max = 10.0,
            .origin = Origin::kGuessed});
  f.Integer(
      "area_window", area_window,
      {.meaning =
           "number of frames before and after over which the median area for area_factor is taken",
       .unit = "frames",
       .min = 1,
       .max = 1000,
       .origin = Origin::kGuessed});
}

void OutlineSettings::Describe(Fields& f) {
  f.Integer(
      "reach_px", reach_px,
      {.meaning = "distance up to which pixels decide whether a pixel near an outline belongs "
                  "to the person; thinner parts that are twice as long keep their pixels; 0: each "
                  "pixel decides for itself",
       .unit = "px",
       .min = 0,
       .max = 10,
       .origin = Origin::kTuned});
  f.Number("spread_px", spread_px,
           {.meaning = "standard deviation of the weights of those pixels over their distance; it "
                       "should be above that of the sensor's displacement of edges",
            .unit = "px",
            .min = 0.1,
            .max = 10.0,
            .origin = Origin::kTuned,
            .source = "Nguyen, Izadi & Lovell 2012: a Kinect v1 displaces edges by 0.8 px"});
  f.Number("depth_share", depth_share,
           {.meaning = "share of the way from the room's depth to the person's from which on a "
                       "pixel counts fully as the person's",
            .min = 0.01,
            .max = 1.0,
            .origin = Origin::kTuned});
  f.Number("least_sigmas", least_sigmas,
           {.meaning = "least length of that way, in standard deviations of the sensor's noise",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kTuned});
  f.Number(
      "doubtful_weight", doubtful_weight,
      {.meaning = "weight, as background, of a pixel without measurement and of one whose depth "
                  "is neither the person's nor the room's",
       .min = 0.0,
       .max = 1.0,
       .origin = Origin::kTuned});
}

void PersonSettings::Describe(Fields& f) {
  f.Choice(
      "choose", choose,
      {{"largest", PersonChoice::kLargest},
       {"nearest", PersonChoice::kNearest},
       {"pixel", PersonChoice::kPixel}},
      {.meaning = "selection among several people: the one with the largest area, summed over the "
                  "frames; the one nearest to the camera on average; or the one at a pixel"});
  f.Integer("frame", frame, {.meaning = "frame of the chosen pixel", .min = 0, .max = 1e6});
  f.Integer("u", u,
            {.meaning = "column of the chosen pixel in the sequence's images",
             .unit = "px",
             .min = 0,
             .max = 1e5});
  f.Integer("v", v,
            {.meaning = "row of the chosen pixel in the sequence's images",
             .unit = "px",
             .min = 0,
             .max = 1e5});
  f.Section("size", size, {.meaning = "sizes that a piece must have to be a person"});
  f.Section("touching", touching, {.meaning = "separation of people who touch"});
}

void CutoutSettings::Describe(Fields& f) {
  f.Number("near_m", near_m,
           {.meaning = "depth below which nothing is kept", .unit = "m", .min = 0.0, .max = 100.0});
  f.Number(
      "far_m", far_m,
      {.meaning = "depth beyond which nothing is kept", .unit = "m", .min = 0.0, .max = 100.0});
  f.Number(
      "noise_sigmas", noise_sigmas,
      {.meaning = "standard deviations of the sensor's noise by which a pixel must differ from "
                  "background and floor",
       .min = 0.0,
       .max = 10.0,
       .origin = Origin::kGuessed});
  f.Number("noise_at_1m_m", noise_at_1m_m,
           {.meaning = "standard deviation of depth at 1 m, growing with the square of depth; "
                       "measured from the recording where it has two frames or more",
            .unit = "m",
            .min = 0.0,
            .max = 0.1,
            .origin = Origin::kPaper,
            .source = "Khoshelham and Elberink 2012, Kinect v1: 1.43 mm at 1 m"});
  f.Section("background", background, {.meaning = "background: the room behind the person"});
  f.Section("floor", floor, {.meaning = "the floor under the person"});
  f.Section("pieces", pieces,
            {.meaning = "connected components of the foreground in three dimensions"});
  f.Section("person", person, {.meaning = "the person that is kept"});
  f.Section("following", following, {.meaning = "how people are followed from frame to frame"});
  f.Section("outline", outline, {.meaning = "how outlines of people are smoothed"});
  f.Integer(
      "seed", seed,
      {.meaning = "seed of the random points in the search for the floor", .min = 0, .max = 1e9});
}

std::string CutoutSettings::Problem() const {
  if (near_m >= far_m)
    return fmt::format("near_m is {} and far_m {}, expected near_m below far_m", near_m, far_m);
  return "";
}

}  // namespace vitruvia
