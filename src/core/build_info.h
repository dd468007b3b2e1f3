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

}  // namespace vitruvia
