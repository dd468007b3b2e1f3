#include "subjects/learned_regression.h"

#include "learning/shape/scape_mesh.h"

namespace vitruvia {
namespace {

constexpr int kTestedPoses = 10;  // of each person

std::vector<PosedPerson> PeopleOf(const BodyDatabase& database) {
  std::vector<PosedPerson> people;
  for (std::size_t i = 0; i < database.examples.size(); ++i) {
    const DatabaseSubject& subject = database.subjects[i];
    people.push_back({subject.skeleton, subject.vertices, database.examples[i].poses});
  }
  return people;
}

// The deformations that a regression gives in a pose.
std::vector<Matrix3<double>> Deformations(const PoseRegression& regression,
                                          const std::array<Vector3d, kBoneCount>& turns) {
  std::vector<Matrix3<double>> q;
  for (const TrianglePoseModel& model : regression.triangles)
    q.push_back(DeformationOf(model, turns));
  return q;
}

double MeanDistance(const std::vector<Vector3d>& surface, const std::vector<Vector3f>& posed) {
  Vector3d shift = Vector3d::Zero();
  for (std::size_t v = 0; v < posed.size(); ++v) shift += posed[v].cast<double>() - surface[v];
  shift /= static_cast<double>(posed.size());
  double sum = 0.0;
  for (std::size_t v = 0; v < posed.size(); ++v)
    sum += (surface[v] + shift - posed[v].cast<double>()).norm();
  return sum / static_cast<double>(posed.size());
}

// Of a person's first poses.
struct PersonErrors {
  double with_m = 0.0, without_m = 0.0;
};
PersonErrors ErrorsOf(const PoseRegression& regression, const BodyModel& reference,
                      const PosedPerson& person) {
  const std::vector<Triangle>& triangles = reference.rest.triangles;
  const std::vector<int> bones = TriangleBones(triangles, reference.weights);
  const ScapeMesh mesh({person.rest, triangles});
  const int count = std::min(kTestedPoses, static_cast<int>(person.poses.size()));
  PersonErrors errors;
  for (int p = 0; p < count; ++p) {
    const auto rotations = PartRotations(triangles, bones, person.rest, person.poses[p]);
    std::vector<Matrix3<double>> turned;
    for (const int bone : bones) turned.push_back(rotations[bone]);
    const auto q = Deformations(regression, JointRotationVectors(rotations));
    const std::vector<Matrix3<double>> none(bones.size(), Matrix3<double>::Identity());
    errors.with_m += MeanDistance(mesh.Solve(turned, q), person.poses[p]) / count;
    errors.without_m += MeanDistance(mesh.Solve(turned, none), person.poses[p]) / count;
  }
  return errors;
}

}  // namespace

RegressionLearningSettings::RegressionLearningSettings() {
  database.population.subjects = 5;
  database.population.seed = 23;
  database.subjects_with_poses = 5;
}

void RegressionLearningSettings::Describe(Fields& f) {
  f.Section("database", database, {.meaning = "the people and their pose examples"});
  f.Section("regression", regression, {.meaning = "the regression"});
  f.Integer("held_out", held_out,
            {.meaning = "number of people, the last of the database, that are held out for testing",
             .min = 1,
             .max = 100000});
}

std::string RegressionLearningSettings::Problem() const {
  if (database.subjects_with_poses == database.population.subjects &&
      held_out < database.population.subjects) {
    return "";
  }
  return fmt::format(
      "expected pose examples of all {} people and fewer than that held out, got {} and {}",
      database.population.subjects, database.subjects_with_poses, held_out);
}

LearnedRegression LearnRegression(const RegressionLearningSettings& settings) {
  const BodyDatabase database = MakeDatabase(settings.database);
  std::vector<PosedPerson> people = PeopleOf(database);
  const std::vector<PosedPerson> held_out(people.end() - settings.held_out, people.end());
  people.resize(people.size() - held_out.size());
  LearnedRegression learnt;
  learnt.regression = LearnPoseRegression(database.reference, people, settings.regression);
  for (const PosedPerson& person : people) {
    learnt.errors.training_mean_m +=
        ErrorsOf(learnt.regression, database.reference, person).with_m /
        static_cast<double>(people.size());
  }
  for (const PosedPerson& person : held_out) {
    const PersonErrors errors = ErrorsOf(learnt.regression, database.reference, person);
    learnt.errors.held_out_mean_m += errors.with_m / static_cast<double>(held_out.size());
    learnt.errors.without_mean_m += errors.without_m / static_cast<double>(held_out.size());
  }
  return learnt;
}

}  // namespace vitruvia
