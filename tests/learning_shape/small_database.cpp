#include "small_database.h"

#include "synth/population/make_database.h"

namespace vitruvia {

const BodyDatabase& SmallDatabase() {
  static const BodyDatabase database = [] {
    DatabaseSettings settings;
    settings.population.subjects = 40;
    settings.mesh.subdivisions = 1;
    settings.subjects_with_poses = 1;
    settings.poses.poses = 4;
    return MakeDatabase(settings);
  }();
  return database;
}

}  // namespace vitruvia
