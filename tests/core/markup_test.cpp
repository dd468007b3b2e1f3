#include "core/markup.h"

#include <gtest/gtest.h>

namespace vitruvia {
namespace {

TEST(Escaped, LeavesNothingThatMarkupWouldRead) {
  EXPECT_EQ(Escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(Escaped("12 µm\n\tπ"), "12 µm\n\tπ");
  EXPECT_EQ(Escaped(std::string("\x1b[31m\0", 6)), " [31m ");
}

}  // namespace
}  // namespace vitruvia
