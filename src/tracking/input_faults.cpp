#include "tracking/input_faults.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/random.h"

namespace vitruvia {
namespace {

float FaultyDepth(DepthFault kind, float depth_m, double depth_unit_m) {
  switch (kind) {
    case DepthFault::kNone:
      return depth_m;
    case DepthFault::kZero:
      return 0.0f;
    case DepthFault::kMaximum:
      return static_cast<float>(std::numeric_limits<std::uint16_t>::max() * depth_unit_m);
    case DepthFault::kNotANumber:
      return std::numeric_limits<float>::quiet_NaN();
    case DepthFault::kInfinite:
      return std::numeric_limits<float>::infinity();
    case DepthFault::kNegative:
      return -depth_m;
  }
  return depth_m;
}

bool IsNear(const Vector3d& point, const BoneSegment& segment, double radius_m) {
  const Vector3d along = segment[1] - segment[0];
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((point - segment[0]).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - segment[0] - share * along).norm() <= radius_m;
}

bool IsInPlace(const DepthFaultSettings& settings, const FaultContext& context, int u, int v,
               float depth_m) {
  switch (settings.place) {
    case FaultPlace::kImage:
      return true;
    case FaultPlace::kRegion:
      return u >= settings.region_px[0] && v >= settings.region_px[1] &&
             u <= settings.region_px[2] && v <= settings.region_px[3];
    case FaultPlace::kBone: {
      if (!(depth_m > 0.0f)) return false;
      const Vector3d point = context.camera.Unproject<double>(u, v, depth_m);
      return std::any_of(context.bone.begin(), context.bone.end(), [&](const BoneSegment& segment) {
        return IsNear(point, segment, settings.bone_radius_m);
      });
    }
  }
  return false;
}

struct SparedPixel {
  int squared_px;  // from the image's middle, in half pixels
  int u, v;
  float depth_m;
};

// The measured pixels nearest to the image's middle.
std::vector<SparedPixel> SparedPixels(const DepthImage& depth, int count) {
  std::vector<SparedPixel> measured;
  for (int v = 0; count > 0 && v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const int x = 2 * u + 1 - depth.width(), y = 2 * v + 1 - depth.height();
      if (depth(u, v) > 0.0f) measured.push_back({x * x + y * y, u, v, depth(u, v)});
    }
  }
  std::stable_sort(
      measured.begin(), measured.end(),
      [](const SparedPixel& a, const SparedPixel& b) { return a.squared_px < b.squared_px; });
  measured.resize(std::min(measured.size(), static_cast<std::size_t>(count)));
  return measured;
}

// About the origin, which is on the floor between the feet.
void Scale(double factor, Subject& subject) {
  for (Vector3f& vertex : subject.rest.vertices) vertex *= static_cast<float>(factor);
  for (Vector3<double>& joint : subject.skeleton.joints) joint *= factor;
  for (Vector3<double>& tip : subject.skeleton.tips) tip *= factor;
}

}  // namespace

void DepthFaultSettings::Describe(Fields& f) {
  f.Choice("kind", kind,
           {{"none", DepthFault::kNone},
            {"zero", DepthFault::kZero},
            {"maximum", DepthFault::kMaximum},
            {"not_a_number", DepthFault::kNotANumber},
            {"infinite", DepthFault::kInfinite},
            {"negative", DepthFault::kNegative}},
           {.meaning = "value of a damaged pixel: no measurement, the largest number of a 16-bit "
                       "image, NaN, infinity, or its depth with the wrong sign"});
  if (!f.Applies(kind != DepthFault::kNone)) return;
  f.Integer("first_frame", first_frame,
            {.meaning = "first damaged frame", .unit = "frames", .min = 0, .max = 1e6});
  f.Integer("frames", frames,
            {.meaning = "number of damaged frames", .unit = "frames", .min = 1, .max = 1e6});
  f.Choice(
      "place", place,
      {{"image", FaultPlace::kImage}, {"region", FaultPlace::kRegion}, {"bone", FaultPlace::kBone}},
      {.meaning =
           "damaged part of an image: all of it, a rectangle, or the surroundings of a bone"});
  if (f.Applies(place == FaultPlace::kRegion)) {
    f.Numbers(
        "region_px", region_px,
        {.meaning = "left, top, right and bottom of the damaged rectangle, inclusive (region only)",
         .unit = "px",
         .min = 0.0,
         .max = 1e5});
  }
  if (f.Applies(place == FaultPlace::kBone)) {
    f.Text("bone", bone,
           {.meaning = "bone, such as left_forearm, near whose true place pixels are damaged (bone "
                       "only)"});
    f.Number("bone_radius_m", bone_radius_m,
             {.meaning = "distance from the bone within which pixels are damaged (bone only)",
              .unit = "m",
              .min = 0.001,
              .max = 2.0});
  }
  f.Number("share", share,
           {.meaning = "share of the damaged part's pixels, chosen by chance", .min = 0, .max = 1});
  f.Integer(
      "pixels_spared", pixels_spared,
      {.meaning = "number of measured pixels, nearest to the image's centre, that are not damaged",
       .unit = "px",
       .min = 0,
       .max = 1e8});
}

std::string DepthFaultSettings::Problem() const {
  if (place == FaultPlace::kRegion && (region_px[0] > region_px[2] || region_px[1] > region_px[3]))
    return "region_px: expected left, top, right and bottom, left and top first";
  if (place != FaultPlace::kBone || FindBone(bone) >= 0) return "";
  std::vector<std::string_view> names;
  for (const BoneInfo& info : Bones()) names.push_back(info.name);
  return fmt::format("bone \"{}\": expected one of {}", bone, fmt::join(names, ", "));
}

void SubjectFaultSettings::Describe(Fields& f) {
  f.Text("bone_without_vertices", bone_without_vertices,
         {.meaning = "a bone whose weights are moved to its parent, so that no vertex follows it"});
  f.Integer(
      "duplicate_triangles", duplicate_triangles,
      {.meaning = "number of the template's triangles that are duplicated", .min = 0, .max = 1e6});
  f.Integer("degenerate_triangles", degenerate_triangles,
            {.meaning = "triangles added to the template with two corners in one vertex",
             .min = 0,
             .max = 1e6});
  f.Number(
      "size_factor", size_factor,
      {.meaning = "factor on all lengths of the template and its skeleton", .min = 0.1, .max = 10});
}

std::string SubjectFaultSettings::Problem() const {
  if (bone_without_vertices.empty()) return "";
  const int bone = FindBone(bone_without_vertices);
  if (bone >= 0 && Bones()[bone].parent >= 0) return "";
  std::vector<std::string_view> names;
  for (const BoneInfo& info : Bones()) {
    if (info.parent >= 0) names.push_back(info.name);
  }
  return fmt::format("bone_without_vertices \"{}\": expected one of {}", bone_without_vertices,
                     fmt::join(names, ", "));
}

bool InputFaultSettings::AreNone() const {
  return depth.kind == DepthFault::kNone && subject.bone_without_vertices.empty() &&
         subject.duplicate_triangles == 0 && subject.degenerate_triangles == 0 &&
         subject.size_factor == 1.0 && view.AreNone();
}

void InputFaultSettings::Describe(Fields& f) {
  f.Section("depth", depth, {.meaning = "faults of single depth images"});
  f.Section("subject", subject, {.meaning = "faults of the template"});
  f.Section("view", view, {.meaning = "faults of the view of the whole sequence"});
}

std::vector<BoneSegment> BoneSegments(const std::string& bone,
                                      const std::vector<Vector3d>& joints) {
  const int index = FindBone(bone);
  Require(index >= 0 && joints.size() == Bones().size(), "BoneSegments: bone {} of {} joints", bone,
          joints.size());
  const Vector3d& from = joints[static_cast<std::size_t>(index)];
  std::vector<BoneSegment> segments;
  for (std::size_t child = 0; child < Bones().size(); ++child) {
    if (Bones()[child].parent == index) segments.push_back({from, joints[child]});
  }
  if (segments.empty()) segments.push_back({from, from});
  return segments;
}

void DamageFrame(const DepthFaultSettings& settings, const FaultContext& context,
                 DepthFrame& frame) {
  if (!settings.Damages(frame.index)) return;
  const std::vector<SparedPixel> spared = SparedPixels(frame.depth, settings.pixels_spared);
  RandomStream random(static_cast<std::uint64_t>(context.seed),
                      fmt::format("faults/{}", frame.index));
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      float& depth_m = frame.depth(u, v);
      if (random.Uniform() < settings.share && IsInPlace(settings, context, u, v, depth_m)) {
        depth_m = FaultyDepth(settings.kind, depth_m, context.depth_unit_m);
      }
    }
  }
  for (const SparedPixel& pixel : spared) frame.depth(pixel.u, pixel.v) = pixel.depth_m;
}

void DamageSubject(const SubjectFaultSettings& settings, Subject& subject) {
  if (settings.size_factor != 1.0) Scale(settings.size_factor, subject);
  if (!settings.bone_without_vertices.empty()) {
    const int bone = FindBone(settings.bone_without_vertices);
    Eigen::MatrixXf weights = Dense(subject.weights, kBoneCount);
    weights.col(Bones()[bone].parent) += weights.col(bone);
    weights.col(bone).setZero();
    subject.weights = Sparsified(weights);
  }
  // Spread evenly over the mesh.
  const std::vector<Triangle> whole = subject.rest.triangles;
  const auto nth = [&](int k, int count) {
    return whole[static_cast<std::size_t>(k) * whole.size() / static_cast<std::size_t>(count)];
  };
  for (int k = 0; k < settings.duplicate_triangles; ++k) {
    subject.rest.triangles.push_back(nth(k, settings.duplicate_triangles));
  }
  for (int k = 0; k < settings.degenerate_triangles; ++k) {
    const Triangle triangle = nth(k, settings.degenerate_triangles);
    subject.rest.triangles.push_back({triangle[0], triangle[0], triangle[1]});
  }
}

}  // namespace vitruvia
