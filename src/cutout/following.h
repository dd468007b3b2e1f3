// Tracks people through a recording: assigns the pieces of each frame to people.
#pragma once

#include <cstdint>
#include <vector>

#include "cutout/pieces.h"

namespace vitruvia {

// One person's history up to the last frame in which they were seen.
struct FollowedPerson {
  std::vector<int> frames;       // in which they were seen
  std::vector<double> areas_m2;  // in each of them
  std::vector<double> depths_m;  // mean, in each of them
  std::vector<int> touching;     // frames in which they shared a piece with somebody else

  double TotalArea() const;
  double MeanDepth() const;
  bool OverlapsInTime(const FollowedPerson& other) const;
};

class PeopleFollower {
 public:
  PeopleFollower(const Room& room, const CutoutSettings& settings, double fps);

  // To be called with the frames in order. The result holds the number of the person at each pixel,
  // from 1; 0: nobody. A person who left and comes back gets a new number.
  Image<std::uint8_t> Follow(const DepthImage& depth, const Pieces& pieces);

  const std::vector<FollowedPerson>& people() const { return people_; }

 private:
  struct Claim {
    int person = 0;  // from 1
    int pixels = 0;
  };

  std::vector<std::vector<Claim>> ClaimsOn(const DepthImage& depth, const Pieces& pieces) const;
  void AssignByOverlap(const std::vector<std::vector<Claim>>& claims, const Pieces& pieces);
  void AssignParts(const Pieces& pieces);
  void FindLostAgain(const Pieces& pieces);
  void BeginNew(const Pieces& pieces);
  Image<std::uint8_t> Painted(const DepthImage& depth, const Pieces& pieces);
  void Remember(const DepthImage& depth, const Pieces& pieces, const Image<std::uint8_t>& people);
  bool IsHere(int person) const;
  bool IsSeenNow(int person) const;

  struct Last {
    int frame = -1, pixels = 0;
    Eigen::AlignedBox3f box;
  };

  Room room_;
  CutoutSettings settings_;
  double fps_;
  int frame_ = 0;
  std::vector<FollowedPerson> people_;
  std::vector<Last> last_;                // of each person
  std::vector<std::vector<int>> owners_;  // of each piece of this frame
  Image<std::uint8_t> people_before_;     // of the last frame, with its depth
  DepthImage depth_before_;
};

}  // namespace vitruvia
