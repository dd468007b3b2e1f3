#include "core/message.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(Counted, PutsTheNounInThePluralUnlessThereIsOne) {
  EXPECT_EQ(Counted(0, "pair"), "0 pairs");
  EXPECT_EQ(Counted(std::size_t{1}, "pair"), "1 pair");
  EXPECT_EQ(Counted(2, "pair"), "2 pairs");
}

}  // namespace
}  // namespace vitruvia
