// Loops over two cores whose results do not depend on how many threads there are.
#pragma once

#include <functional>

namespace vitruvia {

// Calls body(begin, end) for consecutive ranges that together are 0 … count, each once, on up to
// `threads` threads (≥ 1; the caller's is one of them). The ranges depend on `count` alone. A sum
// is the same for any number of threads if every range keeps its own part and the parts are added
// in order afterwards. If calls throw, the exception of the lowest range is thrown again here.
void ParallelFor(int count, int threads, const std::function<void(int begin, int end)>& body);

}  // namespace vitruvia
