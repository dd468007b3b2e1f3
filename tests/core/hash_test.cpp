#include "core/hash.h"

#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/files.h"
#include "tests/support/temporary_folder.h"

namespace vitruvia {
namespace {

// The first three are published test vectors of FNV-1a, 64 bits.
TEST(Hash64, GivesTheGoldenNumbers) {
  EXPECT_EQ(Hash64().value(), 0xcbf29ce484222325u);
  EXPECT_EQ(Hash64().Add("a").value(), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(Hash64().Add("foobar").value(), 0x85944171f73967e8u);
  const unsigned char bytes[] = {0, 255, 128, 10};
  EXPECT_EQ(Hash64().Add(bytes, sizeof(bytes)).value(), 0xd865bb7bf628b7deu);
}

TEST(Hash64, AddsPieceByPieceAsIfAtOnce) {
  EXPECT_EQ(Hash64().Add("foo").Add("").Add("bar").value(), Hash64().Add("foobar").value());
}

TEST(Hash64, WritesSixteenDigits) {
  EXPECT_EQ(Hash64().Add("a").Hex(), "af63dc4c8601ec8c");
  EXPECT_EQ(Hash64().Add("16").Hex().size(), 16u);
}

TEST(Hash64, AddsAFileAsItsBytes) {
  const TemporaryFolder folder;
  std::string content(200'000, '\0');  // longer than one read
  for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * i >> 3);
  WriteWholeFile(folder / "file", content);
  EXPECT_EQ(Hash64().AddFile(folder / "file").value(), Hash64().Add(content).value());
  WriteWholeFile(folder / "empty", "");
  EXPECT_EQ(Hash64().AddFile(folder / "empty").value(), Hash64().value());
}

TEST(Hash64, RefusesWhatIsNoReadableFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(Hash64().AddFile(folder / "missing"), DataError);
  EXPECT_THROW(Hash64().AddFile(folder.path()), DataError);
}

}  // namespace
}  // namespace vitruvia
