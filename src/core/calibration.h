// The machine's current speed: the time of a fixed piece of work.
#pragma once

namespace vitruvia {

// Milliseconds that a fixed kernel takes: dependent floating-point arithmetic, and reads and writes
// scattered over more memory than the inner caches hold. The median of several passes, some 60 ms
// in all. Dividing a time of the same process by it gives a ratio that is roughly comparable across
// machines. Ratios measured with different versions of the kernel are not comparable.
double CalibrationMs();

}  // namespace vitruvia
