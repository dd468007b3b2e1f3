// Poses in which a subject was tracked well: hypotheses for finding it again.
#pragma once

#include <algorithm>
#include <vector>

namespace vitruvia {

template <class Pose>
class PoseMemory {
 public:
  using Distance = double (*)(const Pose&, const Pose&);

  // Holds at most `capacity` (≥ 1) poses, each at least `min_distance` from all others.
  PoseMemory(int capacity, double min_distance, Distance distance)
      : capacity_(static_cast<std::size_t>(capacity)),
        min_distance_(min_distance),
        distance_(distance) {}

  // Stores the pose if it is far enough from all others. Once the memory is full, it replaces the
  // oldest pose except the first one, that of the first frame, which is always kept.
  void Remember(const Pose& pose) {
    const bool is_new = std::all_of(poses_.begin(), poses_.end(), [&](const Pose& other) {
      return distance_(pose, other) >= min_distance_;
    });
    if (!is_new) return;
    if (poses_.size() < capacity_) {
      poses_.push_back(pose);
    } else if (poses_.size() > 1) {
      poses_[next_] = pose;
      next_ = next_ + 1 < poses_.size() ? next_ + 1 : 1;
    }
  }

  const std::vector<Pose>& poses() const { return poses_; }

 private:
  std::size_t capacity_;
  double min_distance_;
  Distance distance_;
  std::vector<Pose> poses_;
  std::size_t next_ = 1;  // index of the next pose to be replaced
};

}  // namespace vitruvia
