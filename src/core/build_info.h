// What this build is: for `vitruvia --version` and for every run record.
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

// Both of the above, as records carry them.
nlohmann::json Provenance();
// That and calibration_ms, how fast the machine is at this moment (core/calibration.h): for records
// of work that was timed just before. Takes some 0.1 s.
nlohmann::json TimedProvenance();

}  // namespace vitruvia
