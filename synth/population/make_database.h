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

// The example poses of the population's subject of that name.
PoseExamples MakePoseExamples(const DatabaseSettings& settings, const std::string& name,
                              const ControlBody& body);
// "s000", "s001", …
std::string SubjectName(int number);

// The same settings give the same database. The first subjects_with_poses subjects have pose
// examples. The provenance states how the examples differ from linear blend skinning.
BodyDatabase MakeDatabase(const DatabaseSettings& settings);

}  // namespace vitruvia
