// Identity of this build, for `vitruvia --version` and every run record.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace vitruvia {

struct BuildInfo {
  std::string version, commit, compiler, build_type, flags, libraries;
  std::string
      build_id;  // the linker's identity of the running program: differs whenever its code does
};
const BuildInfo& GetBuildInfo();

struct MachineInfo {
  std::string cpu;
  int threads = 1;
};
MachineInfo GetMachineInfo();

// Build and machine, as stored in records.
nlohmann::json Provenance();
// Provenance() with calibration_ms, the machine's current speed (core/calibration.h), for records
// of work that has just been timed. Takes about 0.1 s.
nlohmann::json TimedProvenance();

}  // namespace vitruvia
