// The pause between searches that find nothing.
#pragma once

#include <algorithm>

namespace vitruvia {

// Counts frames; each search without success doubles the pause before the next one.
class SearchPause {
 public:
  explicit SearchPause(int least_frames) : least_(least_frames) {}

  void NextFrame() { left_ = std::max(left_ - 1, 0); }
  bool is_over() const { return left_ == 0; }
  // To be called at a search.
  void Begin() { left_ = length_ = std::max(2 * length_, least_); }
  // To be called when there is nothing to search, or after success: the next search may come at
  // once, and the pause after it is the least again.
  void Reset() { left_ = length_ = 0; }

 private:
  int least_ = 1;
  int length_ = 0, left_ = 0;  // frames
};

}  // namespace vitruvia
