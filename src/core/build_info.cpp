#include "core/build_info.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <link.h>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commit.h"
#include "core/calibration.h"

namespace vitruvia {
namespace {

// Finds the GNU build-id note in the program's own segments.
int FindBuildId(dl_phdr_info* info, std::size_t, void* result) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader states addresses as integers
    const char* note = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    const char* end = note + segment.p_memsz;
    while (note + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) header;
      std::memcpy(&header, note, sizeof(header));
      const char* name = note + sizeof(header);
      const char* content = name + (header.n_namesz + 3) / 4 * 4;
      if (header.n_type == NT_GNU_BUILD_ID && header.n_namesz == 4 &&
          std::memcmp(name, "GNU", 4) == 0) {
        auto& text = *static_cast<std::string*>(result);
        for (unsigned k = 0; k < header.n_descsz; ++k) {
          text += fmt::format("{:02x}", static_cast<unsigned char>(content[k]));
        }
        return 1;
      }
      note = content + (header.n_descsz + 3) / 4 * 4;
    }
  }
  return 1;  // the first object is the program itself; the others are shared libraries
}

std::string CpuName() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

BuildInfo MakeBuildInfo() {
  BuildInfo info{VITRUVIA_VERSION,
                 VITRUVIA_COMMIT,
                 "g++ " __VERSION__,
                 VITRUVIA_BUILD_TYPE,
                 VITRUVIA_FLAGS,
                 VITRUVIA_LIBRARIES,
                 ""};
  dl_iterate_phdr(FindBuildId, &info.build_id);
  return info;
}

}  // namespace

const BuildInfo& GetBuildInfo() {
  static const BuildInfo info = MakeBuildInfo();
  return info;
}

MachineInfo GetMachineInfo() {
  return {CpuName(), static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))};
}

nlohmann::json Provenance() {
  const BuildInfo& build = GetBuildInfo();
  const MachineInfo machine = GetMachineInfo();
  return {
      {"version", build.version},       {"commit", build.commit}, {"compiler", build.compiler},
      {"build_type", build.build_type}, {"flags", build.flags},   {"libraries", build.libraries},
      {"build_id", build.build_id},     {"cpu", machine.cpu},     {"cpu_threads", machine.threads}};
}

nlohmann::json TimedProvenance() {
  nlohmann::json provenance = Provenance();
  provenance["calibration_ms"] = CalibrationMs();
  return provenance;
}

}  // namespace vitruvia
