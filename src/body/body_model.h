// A body: surface in the rest pose, skeleton, skinning weights and the person's attributes.
#pragma once

#include <filesystem>
#include <string>

#include "body/skinning.h"

namespace vitruvia {

enum class Sex { kFemale, kMale };

struct BodyAttributes {
  double height_m = 0.0;
  double weight_kg = 0.0;
  Sex sex = Sex::kFemale;
};

struct BodyModel {
  std::string name;
  TriangleMesh rest;  // T-pose in the subject frame, feet on y = 0
  SkinWeights weights;
  Skeleton skeleton;
  BodyAttributes attributes;
};

// DataError naming what is inconsistent: mesh not closed, not finite, weights and vertices of
// different number, a bone index out of range, joints not finite.
void CheckBodyModel(const BodyModel& body, const std::string& where);

// A folder with mesh.ply, subject.json (attributes, skeleton) and weights.bin
// (V × 4 × (uint8 bone, 3 bytes of padding, float32 weight), little-endian).
BodyModel ReadBodyModel(const std::filesystem::path& folder);
void WriteBodyModel(const std::filesystem::path& folder, const BodyModel& body);

// Reads weights.bin alone. DataError if it does not hold vertex_count vertices.
SkinWeights ReadWeights(const std::filesystem::path& file, std::size_t vertex_count);
void WriteWeights(const std::filesystem::path& file, const SkinWeights& weights);

}  // namespace vitruvia
