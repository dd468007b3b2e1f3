// Extraction of the scanned surface from a volume, its cleaning, and its components and holes.
#pragma once

#include <vector>

#include "geometry/mesh.h"
#include "learning/scan/settings.h"
#include "learning/scan/tsdf_volume.h"

namespace vitruvia {

// A connected piece of the surface.
struct SurfaceComponent {
  double area_m2 = 0.0;
  Eigen::AlignedBox3f box;
  int triangles = 0;
  bool kept = false;
};

// A hole: a closed chain of edges with a triangle on one side only.
struct BoundaryLoop {
  double perimeter_m = 0.0;
  double area_m2 = 0.0;                // of the opening: the length of the loop's vector area
  Vector3f center = Vector3f::Zero();  // mean of its edges' midpoints, weighted by length
  int edges = 0;
};

struct ScanSurface {
  TriangleMesh mesh;                         // subject frame, metres, outward
  std::vector<Vector3f> normals;             // per vertex, unit length
  std::vector<float> weights;                // per vertex: the volume's weight there, > 0
  std::vector<SurfaceComponent> components;  // before cleaning, largest first
  std::vector<BoundaryLoop> holes;           // after cleaning, longest first
};

// The zero level of the distances between observed voxels (vtkFlyingEdges3D), unclean.
struct RawSurface {
  TriangleMesh mesh;
  std::vector<float> weights;
};
RawSurface ExtractSurface(const TsdfVolume& volume, double min_weight);

// Contracts edges shorter than short_edge_m, drops triangles without area, and drops components
// of less than island_share of the largest one's area.
ScanSurface Cleaned(RawSurface raw, double short_edge_m, double island_share);

std::vector<BoundaryLoop> FindBoundaryLoops(const TriangleMesh& mesh);  // longest first

}  // namespace vitruvia
