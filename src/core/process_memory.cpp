#include "core/process_memory.h"

#include <fstream>
#include <malloc.h>
#include <string>

namespace vitruvia {
namespace {

// A line reads "VmRSS:     1234 kB", where kB are 1024 bytes.
double StatusLine_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == name && status >> kib) return kib * 1024e-6;
  }
  return 0.0;
}

}  // namespace

double ResidentMemory_mb() { return StatusLine_mb("VmRSS:"); }

double PeakMemory_mb() { return StatusLine_mb("VmHWM:"); }

void ForgetPeakMemory() {
  malloc_trim(0);  // what is free but resident would be used again uncounted
  constexpr char kResetPeak = '5';
  std::ofstream("/proc/self/clear_refs") << kResetPeak;
}

}  // namespace vitruvia
