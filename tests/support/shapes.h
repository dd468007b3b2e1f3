// Closed quad meshes with known properties.
#pragma once

#include "geometry/mesh.h"

namespace vitruvia::shapes {

QuadMesh Cube();                        // corners at ±1; volume 8, 8 vertices, 6 quads
QuadMesh Torus(int around, int along);  // radii 1 and 0.4; genus 1, all vertices of valence 4

// The cube subdivided and pushed out onto the unit sphere: 6·4^steps quads.
QuadMesh Sphere(int steps);

// `mesh` after one Catmull–Clark step.
QuadMesh Subdivided(const QuadMesh& mesh);

// With every coordinate moved by up to `amount` either way.
QuadMesh Shaken(QuadMesh mesh, float amount);

// Both meshes in one, not connected.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace vitruvia::shapes
