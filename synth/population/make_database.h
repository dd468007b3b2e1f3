// From a population to a body database (learning/shape/body_database.h).
#pragma once

#include "learning/shape/body_database.h"
#include "synth/population/example_poses.h"
#include "synth/population/population.h"

namespace vitruvia {

struct DatabaseSettings {
  PopulationSettings population;
  RefinementSettings mesh;      // the learning mesh, of control bodies
  int subjects_with_poses = 8;  // each pose of a MakeHuman body takes 160 kB
  ExamplePoseSettings poses;

  DatabaseSettings();
  void Describe(Fields& fields);
  std::string Problem() const;
};

// The poses that a subject of the population, of that name, is given as examples.
PoseExamples MakePoseExamples(const DatabaseSettings& settings, const std::string& name,
                              const ControlBody& body);
// "s000", "s001", …
std::string SubjectName(int number);

// Same settings: the same database. The first
// subjects_with_poses of them have pose examples. How examples differ from linear blend skinning
// stands in the provenance.
BodyDatabase MakeDatabase(const DatabaseSettings& settings);

}  // namespace vitruvia
