// The skinned surface as a structure of arrays, processed eight vertices at a time.
//
// Vertices that follow the same bones are stored contiguously, so that the bones are constants of
// an inner loop. A run of them is a patch; patches are padded to whole lanes with copies of their
// last vertex. A vertex's index in this order is its slot.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "body/skinning.h"
#include "math/lanes.h"
#include "methods/dynamic/kinematic_tree.h"

namespace vitruvia::dynamic {

// Maximum number of slots of a patch, the unit of work, so that threads get equal shares.
inline constexpr int kMaxPatchSlots = 512;

struct Patch {
  int influences = 0;                       // bones that its vertices follow, 1 … 4
  std::array<int, kMaxInfluences> bones{};  // the one of the largest weights first
  int begin = 0, end = 0;                   // slots, multiples of kLanes
};

struct SurfaceLayout {
  explicit SurfaceLayout(const SkinWeights& weights);

  int slot_count() const { return static_cast<int>(vertex_of_slot.size()); }
  int vertex_count() const { return static_cast<int>(slot_of_vertex.size()); }

  std::vector<Patch> patches;
  std::vector<int> vertex_of_slot;  // −1: padding
  std::vector<int> slot_of_vertex;
};

template <class Scalar>
struct Columns {
  std::vector<Scalar> x, y, z;

  void Resize(int size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
  }
  Vector3<Scalar> At(int slot) const { return {x[slot], y[slot], z[slot]}; }
  void Set(int slot, const Vector3<Scalar>& v) {
    x[slot] = v.x();
    y[slot] = v.y();
    z[slot] = v.z();
  }
};

template <class Scalar>
struct Surface {
  Surface(const SkinWeights& skin, const std::vector<Vector3f>& rest_vertices,
          const std::vector<Vector3f>& rest_unit_normals);

  SurfaceLayout layout;
  std::array<std::vector<Scalar>, kMaxInfluences> weights;  // in the order of the patch's bones
  Columns<Scalar> rest;                                     // v̄ + ω, subject frame, metres
  Columns<Scalar> rest_normals;                             // unit, subject frame
  Columns<Scalar> posed;    // b̂(v̄ + ω), camera frame, metres (eqs. 4 and 5)
  Columns<Scalar> normals;  // unit, camera frame
};

// The bones' dual quaternions in the surface's precision.
template <class Scalar>
using BoneMotions = std::array<DualQuaternion<Scalar>, kBoneCount>;
template <class Scalar>
BoneMotions<Scalar> MotionsOf(const TreePose& pose);

// Eqs. 3 to 5 for the vertices of one patch, and their normals.
//
// Departure: a normal is that of the rest mesh (with its warps) rotated by the vertex's blended
// rotation, not recomputed from the posed triangles. Both are equal where one bone moves a vertex;
// at a bent joint they differ by the shear of the bend.
template <class Scalar>
void PosePatch(const Patch& patch, const BoneMotions<Scalar>& bones, Surface<Scalar>& surface);

}  // namespace vitruvia::dynamic
