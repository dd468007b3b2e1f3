// The transform half of an alternation: improves the rigid transforms of all bones for given
// weights.
//
// Poses are independent of each other, and a pose's problem depends on the vertices only through
// the moments, so the cost does not depend on the number of vertices.
#pragma once

#include <vector>

#include "core/worker_team.h"
#include "learning/skinning/pose_equations.h"
#include "learning/skinning/settings.h"

namespace vitruvia::skinning {

class TransformStep {
 public:
  TransformStep(int bones, int poses, TransformSolver solver, int steps, WorkerTeam& team);
  ~TransformStep();

  // Moves the transforms so that the energy of `moments`, taken at `stack`, does not rise; returns
  // the energy reached. Bones that move no vertex stay where they are.
  double Solve(const BonePattern& pattern, const SkinMoments& moments, BoneStack& stack);

 private:
  struct Workspace;

  TransformSolver solver_;
  int steps_;
  WorkerTeam& team_;
  std::vector<Workspace> workspaces_;
  std::vector<double> gains_;  // per pose
};

}  // namespace vitruvia::skinning
