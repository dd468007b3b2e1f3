// docs/stored_data.md lists the keys as the program describes them.
#include <gmock/gmock.h>

#include "core/files.h"
#include "records/estimate.h"
#include "records/run_record.h"

namespace vitruvia {
namespace {

template <class Struct>
std::string TableOf() {
  std::string table = "| key | type | unit | meaning |\n|---|---|---|---|\n";
  for (const FieldDescription& field :
       DescribeSettings("", VisitDefaults<Struct>, FileKind::kStoredData)) {
    table +=
        fmt::format("| `{}` | {} | {} | {} |\n", field.key, field.type, field.unit, field.meaning);
  }
  return table;
}

TEST(StoredDataPage, ListsEveryKeyAsTheProgramDescribesIt) {
  const std::string page =
      ReadWholeFile(std::filesystem::path(VITRUVIA_SOURCE_DIR) / "docs/stored_data.md");
  for (const std::string& table : {TableOf<RunRecord>(), TableOf<EstimateFile>(),
                                   TableOf<ExperimentSummary>(), TableOf<ExperimentRecord>()}) {
    EXPECT_NE(page.find(table), std::string::npos) << "expected in the page:\n" << table;
  }
}

TEST(StoredDataPage, StatesTheVersionsThatAreWritten) {
  const std::string page =
      ReadWholeFile(std::filesystem::path(VITRUVIA_SOURCE_DIR) / "docs/stored_data.md");
  EXPECT_THAT(page, testing::HasSubstr(
                        fmt::format("| `estimate.json` | {} |", EstimateFile::kFormat.version)));
  EXPECT_EQ(RunRecord::kFormat.version, ExperimentSummary::kFormat.version);
  EXPECT_THAT(page, testing::ContainsRegex(fmt::format("`record.json`.*`summary.json`.* [|] {} [|]",
                                                       RunRecord::kFormat.version)));
}

}  // namespace
}  // namespace vitruvia
