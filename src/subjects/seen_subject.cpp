#include "subjects/seen_subject.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/build_info.h"
#include "core/error.h"
#include "geometry/zbuffer.h"
#include "learning/shape/tracking_template.h"
#include "math/statistics.h"
#include "metrics/reconstruction_error.h"

namespace vitruvia {
namespace {

constexpr double kVisibleWithin_m = 0.02;
constexpr int kComparedPoints = 5000;

std::vector<int> ChosenFrames(int all, const SeenSubjectSettings& settings) {
  const int among = settings.first_frames > 0 ? std::min(settings.first_frames, all) : all;
  const int count = std::min(settings.frames, among);
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i) chosen.push_back(i * among / count);
  return chosen;
}

// Neighbouring pixels whose depths differ little, joined by triangles.
TriangleMesh SurfaceSeen(const DepthImage& depth, const PinholeCamera& camera) {
  constexpr float kSameSurface_m = 0.06f;
  TriangleMesh mesh;
  Image<int> vertex_at(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      vertex_at(u, v) = -1;
      if (!(depth(u, v) > 0.0f)) continue;
      vertex_at(u, v) = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(
          camera.Unproject<float>(static_cast<float>(u), static_cast<float>(v), depth(u, v)));
    }
  }
  const auto add = [&](const std::array<Pixel, 3>& corners) {
    Triangle triangle;
    float nearest = std::numeric_limits<float>::infinity(), farthest = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
      const Pixel& p = corners[k];
      triangle[k] = vertex_at(p.u, p.v);
      if (triangle[k] < 0) return;
      nearest = std::min(nearest, depth(p.u, p.v));
      farthest = std::max(farthest, depth(p.u, p.v));
    }
    if (farthest - nearest <= kSameSurface_m) mesh.triangles.push_back(triangle);
  };
  for (int v = 0; v + 1 < depth.height(); ++v) {
    for (int u = 0; u + 1 < depth.width(); ++u) {
      add({Pixel{u, v}, Pixel{u, v + 1}, Pixel{u + 1, v}});
      add({Pixel{u + 1, v}, Pixel{u, v + 1}, Pixel{u + 1, v + 1}});
    }
  }
  return mesh;
}

TriangleMesh PosedBodyMesh(const BodyModel& model, const BoneTransforms& camera_from_model) {
  TriangleMesh posed = model.rest;
  SkinLinear(model.rest.vertices, model.weights, camera_from_model, posed.vertices);
  return posed;
}

// Seen from the camera's side, y up, over the origin.
TriangleMesh ForView(TriangleMesh mesh, const Vector3f& middle) {
  for (Vector3f& v : mesh.vertices) v = Vector3f(1.0f, -1.0f, -1.0f).cwiseProduct(v - middle);
  return mesh;
}

}  // namespace

void SeenSubjectSettings::Describe(Fields& f) {
  f.Integer("frames", frames,
            {.meaning = "frames, evenly spread, that one shape of the person is fitted to",
             .min = 1,
             .max = 1000,
             .origin = Origin::kGuessed});
  f.Integer("first_frames", first_frames,
            {.meaning = "number of a recording's first frames among which the fitted ones are "
                        "chosen; 0: all",
             .min = 0,
             .max = 1000000});
  f.Section("registration", registration, {.meaning = "how a body is put onto the frames"});
}

SeenSubject SubjectFromFrames(const SequenceReader& sequence, Registrar& registrar,
                              const SeenSubjectSettings& settings) {
  const PinholeCamera& camera = sequence.info().camera;
  const std::vector<int> chosen = ChosenFrames(sequence.info().frames, settings);
  std::vector<DepthImage> depths;
  for (const int frame : chosen) depths.push_back(sequence.ReadDepth(frame));
  const std::vector<Registration> registrations = registrar.FindSame(depths, camera);
  SeenSubject seen;
  ZBuffer zbuffer(camera);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Registration& registration = registrations[i];
    if (!registration.problem.empty()) {
      throw DataError(fmt::format("{}: frame {}: {}", sequence.folder().string(), chosen[i],
                                  registration.problem));
    }
    const BodyModel model = registrar.Body(registration.state.theta);
    SeenFrame frame{chosen[i],
                    registration,
                    SurfaceSeen(depths[i], camera),
                    PosedBodyMesh(model, registrar.SurfaceFromSubject(registration.state)),
                    {}};
    frame.distance =
        CompareWithObservation(frame.body, depths[i], sequence.ReadDepthWithRoom(chosen[i]), camera,
                               kVisibleWithin_m, kComparedPoints, zbuffer);
    seen.frames.push_back(std::move(frame));
  }
  const BodyModel model = registrar.Body(registrations.front().state.theta);
  seen.subject = OnTrackingMesh(model, MakeTrackingTemplate(model.rest));
  seen.subject.name = "seen";
  return seen;
}

std::vector<SurfaceStrip> SeenSubjectStrips(const SeenSubject& seen) {
  constexpr double kSideTurn_deg = 70.0;
  std::vector<SurfaceStrip> strips;
  for (const SeenFrame& frame : seen.frames) {
    const Vector3f middle = BoundingBox(frame.body.vertices).center();
    const ShownSurface points{ForView(frame.seen, middle), SurfaceColor::kTruth, {}};
    const ShownSurface body{ForView(frame.body, middle), SurfaceColor::kEstimate, {}};
    ShownSurface errors = points;
    errors.color = SurfaceColor::kError;
    for (const double d : DistancesToSurface(frame.seen.vertices, frame.body))
      errors.values.push_back(static_cast<float>(d));
    const std::vector<double>& distances_m = frame.distance.points_to_model_m;
    strips.push_back({fmt::format("frame {}", frame.frame),
                      fmt::format("observed points to the body: mean {:.1f} mm, p95 {:.1f} mm",
                                  1e3 * Mean(distances_m), 1e3 * Quantile(distances_m, 0.95)),
                      {{"seen", 0.0, {points}},
                       {"registered body", 0.0, {body}},
                       {"both", 0.0, {points, body}},
                       {"both, from the side", kSideTurn_deg, {points, body}},
                       {"distance of what was seen", 0.0, {errors}}}});
  }
  return strips;
}

Json SeenSubjectRecord(const SeenSubject& seen, const SeenSubjectSettings& settings) {
  Json frames = Json::array();
  for (const SeenFrame& f : seen.frames) {
    const ObservationError& d = f.distance;
    frames.push_back({{"frame", f.frame},
                      {"start", f.registration.start},
                      {"points_to_body_mean_m", Mean(d.points_to_model_m)},
                      {"points_to_body_median_m", Quantile(d.points_to_model_m, 0.5)},
                      {"points_to_body_p95_m", Quantile(d.points_to_model_m, 0.95)},
                      {"body_to_points_mean_m", Mean(d.model_to_points_m)},
                      {"silhouette_overlap", d.silhouette_overlap},
                      {"points_unexplained", d.points_unexplained},
                      {"body_in_front", d.model_in_front}});
  }
  const Eigen::VectorXd& theta = seen.frames.front().registration.state.theta;
  return {{"made_by", "vitruvia subject"},
          {"settings", WriteSettings(settings)},
          {"theta", std::vector<double>(theta.begin(), theta.end())},
          {"frames", frames},
          {"build", Provenance()}};
}

}  // namespace vitruvia
