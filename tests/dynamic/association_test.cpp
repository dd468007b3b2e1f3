#include "methods/dynamic/association.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dynamic_fixtures.h"

namespace vitruvia::dynamic {
namespace {

const PinholeCamera kCamera{64, 48, 50.0, 55.0, 30.2, 25.1};

SkinWeights OneBone(int vertices) {
  SkinWeights weights;
  weights.bones.assign(vertices, {0, 0, 0, 0});
  weights.weights.assign(vertices, {1.0f, 0.0f, 0.0f, 0.0f});
  return weights;
}

// Random vertices in the camera's frame; some in the same places, some looking away.
struct Cloudy {
  explicit Cloudy(std::uint64_t seed, int count)
      : surface(OneBone(count), std::vector<Vector3f>(count, Vector3f::Zero()),
                std::vector<Vector3f>(count, -Vector3f::UnitZ())) {
    RandomStream random(seed, "association");
    for (int slot = 0; slot < surface.layout.slot_count(); ++slot) {
      if (surface.layout.vertex_of_slot[slot] < 0) continue;
      Vector3f p(static_cast<float>(random.Uniform(-0.9, 0.9)),
                 static_cast<float>(random.Uniform(-0.6, 0.6)),
                 static_cast<float>(random.Uniform(0.8, 1.6)));
      if (slot > 0 && random.Index(10) == 0) p = surface.posed.At(slot - 1);
      surface.posed.Set(slot, p);
      surface.normals.Set(slot, Vector3f(0.0f, 0.0f, random.Index(4) == 0 ? 1.0f : -1.0f));
    }
    for (int v = 0; v < kCamera.height; v += 2) {
      for (int u = 0; u < kCamera.width; u += 3) {
        const auto z = static_cast<float>(random.Uniform(0.8, 1.6));
        cloud.points.push_back(kCamera.Unproject(static_cast<float>(u), static_cast<float>(v), z));
        cloud.pixels.push_back(v * kCamera.width + u);
      }
    }
  }

  Surface<float> surface;
  PointCloud cloud;
};

int PixelOf(const Vector3f& p) {
  const auto pixel = kCamera.Project(p);
  const int u = static_cast<int>(std::floor(pixel.x() + 0.5f));
  const int v = static_cast<int>(std::floor(pixel.y() + 0.5f));
  if (u < 0 || v < 0 || u >= kCamera.width || v >= kCamera.height) return -1;
  return v * kCamera.width + u;
}

// Every vertex that faces the camera, in the window and within the cutoff, one after the other.
int BruteForce(const Cloudy& c, const Vector3f& point, int pixel, const AssociationLimits& limits) {
  int best = -1;
  float best_squared = limits.cutoff_m * limits.cutoff_m;
  for (int slot = 0; slot < c.surface.layout.slot_count(); ++slot) {
    if (c.surface.layout.vertex_of_slot[slot] < 0) continue;
    const Vector3f p = c.surface.posed.At(slot);
    const float cosine = -c.surface.normals.At(slot).dot(p) / p.norm();
    const int at = PixelOf(p);
    if (!(cosine > limits.facing_cosine) || at < 0) continue;
    const int columns = std::abs(at % kCamera.width - pixel % kCamera.width);
    const int rows = std::abs(at / kCamera.width - pixel / kCamera.width);
    if (std::max(columns, rows) > limits.window_px) continue;
    const float dx = p.x() - point.x(), dy = p.y() - point.y(), dz = p.z() - point.z();
    const float squared = dx * dx + dy * dy + dz * dz;
    if (squared < best_squared) {
      best_squared = squared;
      best = slot;
    }
  }
  return best;
}

void Search(const Cloudy& c, const AssociationLimits& limits, WorkerTeam& team,
            Association& association) {
  for (std::size_t patch = 0; patch < c.surface.layout.patches.size(); ++patch) {
    association.ProjectPatch(static_cast<int>(patch), c.surface, limits);
  }
  association.FindNearest(limits, team);
}

void ExpectBruteForce(const Cloudy& c, const AssociationLimits& limits,
                      const Association& association, const std::string& where) {
  ASSERT_EQ(association.nearest().size(), c.cloud.points.size());
  for (std::size_t i = 0; i < c.cloud.points.size(); ++i) {
    ASSERT_EQ(association.nearest()[i], BruteForce(c, c.cloud.points[i], c.cloud.pixels[i], limits))
        << "point " << i << " " << where;
  }
}

TEST(Association, FindsWhatBruteForceFinds) {
  WorkerTeam team(2);
  for (const int count : {0, 1, 60, 3000}) {
    for (const int window : {0, 1, 3, 12, 100}) {
      for (const float cutoff : {0.02f, 0.1f, 5.0f}) {
        const Cloudy c(static_cast<std::uint64_t>(count + window), count);
        const AssociationLimits limits{window, cutoff, 0.2f};
        Association association(kCamera, c.surface.layout);
        association.SetCloud(c.cloud);
        Search(c, limits, team, association);
        ExpectBruteForce(
            c, limits, association,
            fmt::format("of {} vertices, window {}, cutoff {}", count, window, cutoff));
      }
    }
  }
}

TEST(Association, IsTheSameForAnyNumberOfThreads) {
  const Cloudy c(5, 3000);
  const AssociationLimits limits{12, 0.1f, 0.2f};
  std::vector<float> expected_sums;
  for (const int threads : {1, 2, 3, 4, 7, 64}) {
    WorkerTeam team(threads);
    Association association(kCamera, c.surface.layout);
    association.SetCloud(c.cloud);
    Search(c, limits, team, association);
    ExpectBruteForce(c, limits, association, fmt::format("on {} threads", threads));
    Observations<float> observations;
    observations.Reset(c.surface.layout.slot_count());
    association.Observe(team, observations);
    if (threads == 1) expected_sums = observations.sums;
    EXPECT_EQ(observations.sums, expected_sums) << threads << " threads";
  }
}

TEST(Association, ForgetsWhatItFoundBefore) {
  WorkerTeam team(2);
  Cloudy c(3, 3000);
  Association association(kCamera, c.surface.layout);
  const Vector3f step(0.03f, -0.02f, 0.04f);
  // Vertices move, turn away and fall out of window and cutoff; points come and go.
  const AssociationLimits limits[] = {
      {100, 5.0f, 0.2f}, {12, 0.1f, 0.2f}, {3, 0.1f, 0.7f}, {100, 0.3f, 0.0f}, {12, 0.02f, 0.2f}};
  for (std::size_t search = 0; search < std::size(limits); ++search) {
    association.SetCloud(c.cloud);
    Search(c, limits[search], team, association);
    ExpectBruteForce(c, limits[search], association, fmt::format("in search {}", search));
    for (int slot = 0; slot < c.surface.layout.slot_count(); ++slot) {
      c.surface.posed.Set(slot, c.surface.posed.At(slot) + step);
    }
    const std::size_t points = c.cloud.points.size() * (search % 2 == 0 ? 2 : 4) / 3;
    c.cloud.points.resize(points, c.cloud.points.front());
    c.cloud.pixels.resize(points, c.cloud.pixels.front());
  }
}

// A sheet of vertices before the camera, with points near it: most points keep their vertex while
// the sheet moves little.
struct Sheet : Cloudy {
  Sheet() : Cloudy(11, 5000), random(12, "motion") {
    for (int slot = 0; slot < surface.layout.slot_count(); ++slot) {
      if (surface.layout.vertex_of_slot[slot] < 0) continue;
      const auto x = static_cast<float>(random.Uniform(-0.9, 0.9));
      const auto y = static_cast<float>(random.Uniform(-0.6, 0.6));
      surface.posed.Set(slot, {x, y, HeightAt(x)});
    }
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      const bool is_far = random.Index(10) == 0;  // behind the sheet
      const int u = cloud.pixels[i] % kCamera.width, v = cloud.pixels[i] / kCamera.width;
      const float x = kCamera.Unproject(static_cast<float>(u), 0.0f, 1.2f).x();
      const auto off = static_cast<float>(is_far ? 0.1 : random.Uniform(-0.02, 0.02));
      const float z = HeightAt(x) + off;
      cloud.points[i] = kCamera.Unproject(static_cast<float>(u), static_cast<float>(v), z);
    }
  }

  static float HeightAt(float x) { return 1.2f + 0.05f * std::sin(8.0f * x); }

  // Every vertex by up to far_m, and some vertices turn to the camera or away from it.
  void Move(double far_m) {
    for (int slot = 0; slot < surface.layout.slot_count(); ++slot) {
      if (surface.layout.vertex_of_slot[slot] < 0) continue;
      const Vector3f step(static_cast<float>(random.Uniform(-far_m, far_m)),
                          static_cast<float>(random.Uniform(-far_m, far_m)),
                          static_cast<float>(random.Uniform(-far_m, far_m)));
      surface.posed.Set(slot, surface.posed.At(slot) + step);
      if (random.Index(100) == 0) surface.normals.Set(slot, -surface.normals.At(slot));
    }
  }

  RandomStream random;
};

// As in the iterations of a frame: one cloud, a surface that comes to rest, and cutoffs that fall,
// then rise for the shape.
TEST(Association, ProvesMatchesOnlyWhereTheyAreWhatBruteForceFinds) {
  const double motions_m[] = {0.02, 0.005, 0.001, 0.001, 0.0003, 0.01, 0.01, 0.0003, 0.0001};
  const float cutoffs_m[] = {0.12f, 0.09f, 0.06f, 0.04f, 0.03f, 0.02f, 0.02f, 0.04f, 0.04f};
  constexpr std::pair<int, int> kWindowsAndThreads[] = {{0, 2}, {1, 1}, {4, 3}, {32, 1}, {32, 4}};
  for (const auto& [window, threads] : kWindowsAndThreads) {
    WorkerTeam team(threads);
    Sheet sheet;
    Association association(kCamera, sheet.surface.layout);
    association.SetCloud(sheet.cloud);
    for (std::size_t i = 0; i < std::size(motions_m); ++i) {
      const AssociationLimits limits{window, cutoffs_m[i], 0.2f};
      Search(sheet, limits, team, association);
      ExpectBruteForce(sheet, limits, association,
                       fmt::format("in search {}, window {}", i, window));
      sheet.Move(motions_m[i]);
    }
    const auto points = static_cast<int>(sheet.cloud.points.size());
    EXPECT_LT(association.searched(), window == 0 ? points : points / 2) << window;
  }
}

TEST(Association, KeepsWhatItFoundWhereNothingMoves) {
  WorkerTeam team(2);
  Sheet sheet;
  Association association(kCamera, sheet.surface.layout);
  association.SetCloud(sheet.cloud);
  const AssociationLimits limits{12, 0.1f, 0.2f};
  const auto count = static_cast<int>(sheet.cloud.points.size());
  Search(sheet, limits, team, association);
  EXPECT_EQ(association.searched(), count);
  Search(sheet, limits, team, association);
  EXPECT_LT(association.searched(), count / 4);  // those far from the surface have no bound
  const AssociationLimits wider{20, 0.1f, 0.2f};
  Search(sheet, wider, team, association);
  EXPECT_EQ(association.searched(), count);
  association.SetCloud(sheet.cloud);
  Search(sheet, wider, team, association);
  EXPECT_EQ(association.searched(), count);
}

TEST(Association, SearchesAnewWhereAVertexTurnsToTheCamera) {
  WorkerTeam team(1);
  Surface<float> surface(OneBone(2), std::vector<Vector3f>(2, Vector3f::Zero()),
                         std::vector<Vector3f>(2, -Vector3f::UnitZ()));
  surface.posed.Set(0, {0.004f, 0.0f, 1.0f});
  surface.posed.Set(1, {0.001f, 0.0f, 1.0f});
  surface.normals.Set(0, -Vector3f::UnitZ());
  surface.normals.Set(1, Vector3f::UnitZ());
  PointCloud cloud;
  cloud.pixels = {25 * kCamera.width + 30};
  cloud.points = {kCamera.Unproject(30.0f, 25.0f, 1.0f)};
  Association association(kCamera, surface.layout);
  association.SetCloud(cloud);
  const auto nearest = [&] {
    association.ProjectPatch(0, surface, {});
    association.FindNearest({}, team);
    return association.nearest()[0];
  };
  EXPECT_EQ(nearest(), 0);
  EXPECT_EQ(nearest(), 0);
  EXPECT_EQ(association.searched(), 0);
  surface.normals.Set(1, -Vector3f::UnitZ());
  EXPECT_EQ(nearest(), 1);
  surface.normals.Set(1, Vector3f::UnitZ());
  EXPECT_EQ(nearest(), 0);
  surface.posed.Set(0, {0.09f, 0.0f, 1.0f});  // beyond the cutoff
  EXPECT_EQ(nearest(), -1);
}

TEST(Association, AveragesThePointsThatChoseAVertex) {
  const Cloudy c(9, 50);
  const AssociationLimits limits{100, 5.0f, 0.2f};
  Association association(kCamera, c.surface.layout);
  association.SetCloud(c.cloud);
  WorkerTeam team(1);
  Search(c, limits, team, association);
  Observations<float> observations;
  observations.Reset(c.surface.layout.slot_count());
  association.Observe(team, observations);
  int chosen = 0;
  for (int slot = 0; slot < c.surface.layout.slot_count(); ++slot) {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < c.cloud.points.size(); ++i) {
      if (association.nearest()[i] != slot) continue;
      sum += c.cloud.points[i].cast<double>();
      ++count;
    }
    EXPECT_EQ(observations.Count(slot), static_cast<float>(count));
    if (count == 0) continue;
    ++chosen;
    EXPECT_LT((observations.Mean(slot).cast<double>() - sum / count).norm(), 1e-5);
  }
  EXPECT_GT(chosen, 10);
}

TEST(Observations, BeginAnewAfterTheyAreCleared) {
  Observations<float> observations;
  observations.Reset(2 * kLanes);
  observations.Add(3, {1.0f, 2.0f, 3.0f});
  observations.Add(9, {1.0f, 1.0f, 1.0f});
  observations.Clear(0, kLanes);
  EXPECT_EQ(observations.Count(3), 0.0f);
  EXPECT_EQ(observations.Count(9), 1.0f);
  observations.Add(3, {5.0f, 6.0f, 7.0f});
  observations.Add(3, {7.0f, 8.0f, 9.0f});
  EXPECT_EQ(observations.Count(3), 2.0f);
  EXPECT_EQ(observations.Mean(3), Vector3f(6.0f, 7.0f, 8.0f));
}

TEST(Association, LeavesOutWhatIsNotBeforeTheCamera) {
  Surface<float> surface(OneBone(4), std::vector<Vector3f>(4, Vector3f::Zero()),
                         std::vector<Vector3f>(4, -Vector3f::UnitZ()));
  for (int slot = 0; slot < 4; ++slot) surface.normals.Set(slot, -Vector3f::UnitZ());
  surface.posed.Set(0, {0.0f, 0.0f, 1.0f});
  surface.posed.Set(1, {0.0f, 0.0f, -1.0f});  // behind
  surface.posed.Set(2, {9.0f, 0.0f, 1.0f});   // out of view
  surface.posed.Set(3, {0.0f, 0.0f, 0.0f});   // no direction at all
  Association association(kCamera, surface.layout);
  association.ProjectPatch(0, surface, {});
  EXPECT_EQ(association.PixelOf(0), 25 * kCamera.width + 30);
  for (int slot = 1; slot < surface.layout.slot_count(); ++slot) {
    EXPECT_EQ(association.PixelOf(slot), -1) << slot;
  }
}

}  // namespace
}  // namespace vitruvia::dynamic
