#include "methods/dynamic/shape_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "dynamic_fixtures.h"
#include "math/rigid.h"

namespace vitruvia::dynamic {
namespace {

TEST(SolveWarp, IsTheInverseOfARankOneChange) {
  RandomStream random(1, "warp");
  for (int i = 0; i < 100; ++i) {
    const auto vector = [&] {
      return Vector3d(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2));
    };
    const Vector3d g = vector(), h = vector();
    const double alpha = random.Uniform(0.01, 3.0);
    const Matrix3<double> a = g * g.transpose() + alpha * Matrix3<double>::Identity();
    EXPECT_LT((a * SolveWarp<double>(g, h, alpha) - h).norm(), 1e-11);
  }
}

TEST(ClosestNeighbors, AreTheClosestAmongThoseTwoEdgesAway) {
  const BodyModel body = TinyBody(2);
  const auto& vertices = body.rest.vertices;
  std::vector<std::vector<char>> near(vertices.size(), std::vector<char>(vertices.size(), 0));
  for (const Triangle& t : body.rest.triangles) {
    for (const int a : t) {
      for (const int b : t) near[a][b] = 1;
    }
  }
  const NeighborTable table = ClosestNeighbors(vertices, body.rest.triangles);
  for (std::size_t v = 0; v < vertices.size(); v += 17) {
    std::vector<float> distances;
    for (std::size_t other = 0; other < vertices.size(); ++other) {
      if (other == v) continue;
      bool within_two = false;
      for (std::size_t mid = 0; mid < vertices.size(); ++mid) {
        within_two |= near[v][mid] != 0 && near[mid][other] != 0;
      }
      if (within_two) distances.push_back((vertices[other] - vertices[v]).squaredNorm());
    }
    std::sort(distances.begin(), distances.end());
    for (int k = 0; k < kNeighbors; ++k) {
      ASSERT_GE(table[v][k], 0);
      EXPECT_EQ((vertices[table[v][k]] - vertices[v]).squaredNorm(), distances[k]) << v;
    }
  }
}

// A body in its rest pose before the camera, and points 1 cm before every fourth vertex.
struct ShapeStage {
  explicit ShapeStage(int threads)
      : body(BlendedBody()),
        mesh(SmoothMesh(body)),
        neighbors(ClosestNeighbors(mesh.vertices, mesh.triangles)),
        surface(SurfaceOf<float>(mesh)),
        shape(surface.layout, mesh.vertices, neighbors),
        team(threads) {
    TreePose pose;
    pose.camera_from_rest.fill(DualQuaternion<double>::FromRigid(CameraFromStart()));
    motions = MotionsOf<float>(pose);
    Pose();
    observations.Reset(surface.layout.slot_count());
    for (int v = 0; v < surface.layout.vertex_count(); v += 4) {
      const int slot = surface.layout.slot_of_vertex[v];
      observations.Add(slot, surface.posed.At(slot) + 0.01f * surface.normals.At(slot));
    }
  }

  void Pose() {
    for (const Patch& patch : surface.layout.patches) PosePatch(patch, motions, surface);
  }
  Vector3f WarpOf(int vertex) const { return shape.WarpOf(surface.layout.slot_of_vertex[vertex]); }

  BodyModel body;
  TrackedMesh mesh;
  NeighborTable neighbors;
  Surface<float> surface;
  ShapeStep shape;
  BoneMotions<float> motions;
  Observations<float> observations;
  WorkerTeam team;
};

const ShapeWeights kWeights{0.05f, 0.3f};

// The step written down once more, densely and in double.
std::vector<Vector3d> BruteForceStep(const ShapeStage& s, const std::vector<Vector3d>& warps) {
  std::vector<Vector3d> next(warps.size());
  for (std::size_t v = 0; v < warps.size(); ++v) {
    const int slot = s.surface.layout.slot_of_vertex[v];
    Matrix3<double> a = double{kWeights.magnitude} * Matrix3<double>::Identity();
    Vector3d h = double{kWeights.magnitude} * warps[v];
    for (const int other : s.neighbors[v]) {
      if (other < 0) continue;
      a += double{kWeights.neighbors} * Matrix3<double>::Identity();
      h += double{kWeights.neighbors} * (warps[v] - warps[other]);
    }
    if (s.observations.Count(slot) > 0.0f) {
      const Vector3d n = s.surface.normals.At(slot).cast<double>();
      const Vector3d g = CameraFromStart().rotation.transpose() * n;
      const Vector3d posed = CameraFromStart() * (s.mesh.vertices[v].cast<double>() + warps[v]);
      h += g * n.dot(posed - s.observations.Mean(slot).cast<double>());
      a += g * g.transpose();
    }
    next[v] = warps[v] - a.inverse() * h;
  }
  return next;
}

TEST(ShapeStep, DoesWhatTheEquationSays) {
  ShapeStage stage(1);
  std::vector<Vector3d> warps(stage.mesh.vertices.size(), Vector3d::Zero());
  for (int i = 0; i < 3; ++i) {
    const std::vector<Vector3d> expected = BruteForceStep(stage, warps);
    stage.shape.Iterate(stage.observations, kWeights, stage.team, stage.surface);
    stage.Pose();
    double largest = 0.0;
    for (std::size_t v = 0; v < warps.size(); ++v) {
      const Vector3d warp = stage.WarpOf(static_cast<int>(v)).cast<double>();
      EXPECT_LT((warp - expected[v]).norm(), 2e-6) << v;
      largest = std::max(largest, warp.norm());
      warps[v] = warp;
    }
    EXPECT_GT(largest, 0.003);
  }
}

// The three sums of eq. 9, written down once more in double.
ShapeEnergy BruteForceEnergy(const ShapeStage& s) {
  ShapeEnergy energy;
  for (int v = 0; v < s.surface.layout.vertex_count(); ++v) {
    const int slot = s.surface.layout.slot_of_vertex[v];
    const Vector3d warp = s.WarpOf(v).cast<double>();
    energy.magnitude += double{kWeights.magnitude} * warp.squaredNorm();
    for (const int other : s.neighbors[v]) {
      if (other < 0) continue;
      energy.smoothness +=
          double{kWeights.neighbors} * (warp - s.WarpOf(other).cast<double>()).squaredNorm();
    }
    if (s.observations.Count(slot) == 0.0f) continue;
    const Vector3d offset = (s.surface.posed.At(slot) - s.observations.Mean(slot)).cast<double>();
    energy.data += std::pow(s.surface.normals.At(slot).cast<double>().dot(offset), 2);
  }
  return energy;
}

TEST(ShapeStep, ReportsTheTermsOfItsEnergy) {
  ShapeStage stage(1);
  for (int i = 0; i < 3; ++i) {
    const ShapeEnergy expected = BruteForceEnergy(stage);
    const ShapeEnergy energy =
        stage.shape.Iterate(stage.observations, kWeights, stage.team, stage.surface);
    stage.Pose();
    EXPECT_NEAR(energy.data, expected.data, 1e-4 * expected.data);
    EXPECT_NEAR(energy.magnitude, expected.magnitude, 1e-4 * expected.magnitude);
    EXPECT_NEAR(energy.smoothness, expected.smoothness, 1e-4 * expected.smoothness);
    EXPECT_GT(energy.data, 0.0);
    EXPECT_EQ(energy.smoothness > 0.0, i > 0);  // all warps begin at 0
  }
}

TEST(ShapeStep, LowersItsEnergy) {
  ShapeStage stage(1);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10; ++i) {
    const double energy =
        stage.shape.Iterate(stage.observations, kWeights, stage.team, stage.surface).Total();
    stage.Pose();
    EXPECT_LT(energy, before);
    before = energy;
  }
}

TEST(ShapeStep, IsTheSameForAnyNumberOfThreads) {
  for (const int threads : {2, 3, 4}) {
    ShapeStage one(1), several(threads);
    for (int i = 0; i < 3; ++i) {
      const double expected =
          one.shape.Iterate(one.observations, kWeights, one.team, one.surface).Total();
      const double energy =
          several.shape.Iterate(several.observations, kWeights, several.team, several.surface)
              .Total();
      EXPECT_EQ(energy, expected) << threads << " threads";
    }
    for (int v = 0; v < one.surface.layout.vertex_count(); ++v) {
      EXPECT_EQ(one.WarpOf(v), several.WarpOf(v)) << v;
    }
  }
}

TEST(ShapeStep, LetsWarpsShrinkWhenDataVanish) {
  ShapeStage stage(1);
  for (int i = 0; i < 10; ++i) {
    stage.shape.Iterate(stage.observations, kWeights, stage.team, stage.surface);
    stage.Pose();
  }
  const auto largest = [&] {
    float result = 0.0f;
    for (int v = 0; v < stage.surface.layout.vertex_count(); ++v) {
      result = std::max(result, stage.WarpOf(v).cwiseAbs().maxCoeff());
    }
    return result;
  };
  Observations<float> nothing;
  nothing.Reset(stage.surface.layout.slot_count());
  const float first = largest();
  float before = first;
  for (int i = 0; i < 200; ++i) {
    stage.shape.Iterate(nothing, kWeights, stage.team, stage.surface);
    EXPECT_LE(largest(), before);
    before = largest();
  }
  EXPECT_LT(before, 1e-3f * first);
}

}  // namespace
}  // namespace vitruvia::dynamic
