// How fast this machine is, now: the time of a fixed piece of work.
#pragma once

namespace vitruvia {

// Milliseconds that a fixed kernel takes: dependent floating-point arithmetic, and reads and writes
// scattered over more memory than the inner caches hold. The median of several passes, some 60 ms
// in all. A time of the same process divided by it is a ratio that compares across machines, as far
// as one number can: not across changes of the kernel, which make old ratios worthless.
double CalibrationMs();

}  // namespace vitruvia
