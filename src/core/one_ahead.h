// Work on a series in two steps, side by side on two threads.
#pragma once

#include <exception>
#include <utility>

#include "core/worker_team.h"

namespace vitruvia {

// Calls make(0), make(1), … make(count − 1) and use(i, item) for each item that was made, both in
// this order: while one item is used, the next one is made. Each call may come from either of two
// threads. An exception ends the series, after the items before it were used.
template <class Make, class Use>
void MakeOneAhead(int count, const Make& make, const Use& use) {
  if (count <= 0) return;
  WorkerTeam team(2);
  auto item = make(0);
  for (int i = 0; i + 1 < count; ++i) {
    decltype(item) next;
    std::exception_ptr not_made;  // thrown after what the use of the item before it throws
    team.For(2, 1, [&](int work, int) {
      if (work == 1) return use(i, item);
      try {
        next = make(i + 1);
      } catch (...) {
        not_made = std::current_exception();
      }
    });
    if (not_made) std::rethrow_exception(not_made);
    item = std::move(next);
  }
  use(count - 1, item);
}

}  // namespace vitruvia
