#include "learning/skinning/rigid_pieces.h"

#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "learning/skinning/decomposition.h"
#include "learning_skinning/planted.h"

namespace vitruvia::skinning {
namespace {

TEST(RigidPieces, ArePlantedOnesUnderOtherNames) {
  const Planted planted = Plant({.vertices = 600, .bones = 4, .influences = 1});
  const Labels found = FindRigidPieces(planted.examples, 4, 2);
  std::map<std::uint8_t, std::uint8_t> name;
  for (std::size_t v = 0; v < found.size(); ++v) {
    EXPECT_EQ(name.emplace(planted.labels[v], found[v]).first->second, found[v]) << v;
  }
  EXPECT_EQ(name.size(), 4u);
}

TEST(RigidPieces, OfABendingLimbMoveItBetterThanFewer) {
  const Planted planted = Plant({.vertices = 600});
  double before_m = 1.0;
  for (const int count : {1, 3, 5, 8}) {
    const Labels labels = FindRigidPieces(planted.examples, count, 1);
    Settings settings;
    settings.alternations = 0;
    BoneGraph own(count);
    for (int b = 0; b < count; ++b) own[b] = {static_cast<std::uint8_t>(b)};
    const double rmse_m = Decompose(planted.examples, labels, own, settings).rmse_m;
    EXPECT_LT(rmse_m, before_m);
    before_m = rmse_m;
  }
}

TEST(RigidPieces, AreTheSameForAnyNumberOfThreads) {
  const Planted planted = Plant({.noise_m = 0.001});
  EXPECT_EQ(FindRigidPieces(planted.examples, 6, 1), FindRigidPieces(planted.examples, 6, 3));
}

TEST(RigidPieces, OfAFewVerticesAreFewer) {
  const Planted planted = Plant({.vertices = 30});
  const Labels labels = FindRigidPieces(planted.examples, 7, 1);
  EXPECT_EQ(labels, Labels(30, 0));
  EXPECT_THROW(FindRigidPieces(planted.examples, 0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace vitruvia::skinning
