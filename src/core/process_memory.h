// Memory that this process holds, in MB of 10⁶ bytes, as Linux counts it.
#pragma once

namespace vitruvia {

// What is resident now; 0 where the kernel does not tell.
double ResidentMemory_mb();
// The most that was resident since the process began or since ForgetPeakMemory.
double PeakMemory_mb();
// Gives memory that is free back to the system and lets the peak begin anew from what is resident
// then. A kernel that refuses keeps the old peak.
void ForgetPeakMemory();

}  // namespace vitruvia
