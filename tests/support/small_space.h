// A shape space of the embedded body that is learnt within a test.
#pragma once

#include <numeric>

#include "learning/shape/shape_space.h"
#include "synth/population/make_database.h"

namespace vitruvia {

inline ShapeSpace LearnSmallSpace(int subjects, int components) {
  DatabaseSettings settings;
  settings.population.subjects = subjects;
  settings.mesh.subdivisions = 2;
  settings.subjects_with_poses = 0;
  const BodyDatabase database = MakeDatabase(settings);
  std::vector<int> all(database.subjects.size());
  std::iota(all.begin(), all.end(), 0);
  return LearnShapeSpace(database, all, {.components = components});
}

}  // namespace vitruvia
