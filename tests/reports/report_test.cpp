#include "reports/report.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/files.h"
#include "reports/synthetic_experiment.h"
#include "support/temporary_folder.h"

namespace vitruvia {
namespace {
TEST(Report, Writes) { }
}  // namespace
}  // namespace vitruvia
