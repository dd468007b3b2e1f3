// Memory that this process holds, in MB of 10⁶ bytes, as Linux counts it.
#pragma once

namespace vitruvia {

// Resident memory now; 0 if the kernel does not report it.
double ResidentMemory_mb();
// Peak resident memory since the process started or since ForgetPeakMemory.
double PeakMemory_mb();
// Returns free memory to the system and resets the peak to what is then resident. If the kernel
// refuses, the old peak stays.
void ForgetPeakMemory();

}  // namespace vitruvia
