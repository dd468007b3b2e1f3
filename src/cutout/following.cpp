#include "cutout/following.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "math/statistics.h"

namespace vitruvia {
namespace {

constexpr std::size_t kMostPeople = 255;  // a byte each in the label images

std::size_t Index(int person) { return static_cast<std::size_t>(person - 1); }

float Distance(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return a.exteriorDistance(b);
}

// How far each pixel is from the person's pixels, in pixels.
cv::Mat DistanceTo(int person, const Image<std::uint8_t>& people) {
  const cv::Mat labels(people.height(), people.width(), CV_8UC1,
                       const_cast<std::uint8_t*>(people.pixels().data()));
  cv::Mat others, distance;
  cv::compare(labels, person, others, cv::CMP_NE);
  cv::distanceTransform(others, distance, cv::DIST_L2, cv::DIST_MASK_3, CV_32F);
  return distance;
}

// Gives each pixel of a piece that several people share to the one who was nearest to it before.
void Divide(const Pieces& pieces, int label, const std::vector<int>& owners,
            const Image<std::uint8_t>& people_before, Image<std::uint8_t>& people) {
  std::vector<cv::Mat> distances;
  for (const int person : owners) distances.push_back(DistanceTo(person, people_before));
  for (int v = 0; v < people.height(); ++v) {
    for (int u = 0; u < people.width(); ++u) {
      if (pieces.labels(u, v) != label) continue;
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < owners.size(); ++k) {
        if (distances[k].at<float>(v, u) < distances[nearest].at<float>(v, u)) nearest = k;
      }
      people(u, v) = static_cast<std::uint8_t>(owners[nearest]);
    }
  }
}

}  // namespace

double FollowedPerson::TotalArea() const {
  return std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0);
}

double FollowedPerson::MeanDepth() const { return Mean(depths_m); }

bool FollowedPerson::OverlapsInTime(const FollowedPerson& other) const {
  return frames.front() <= other.frames.back() && other.frames.front() <= frames.back();
}

PeopleFollower::PeopleFollower(const Room& room, const CutoutSettings& settings, double fps)
    : room_(room), settings_(settings), fps_(fps) {}

bool PeopleFollower::IsHere(int person) const {
  return frame_ - last_[Index(person)].frame <= settings_.following.forget_s * fps_;
}

bool PeopleFollower::IsSeenNow(int person) const {
  return std::any_of(owners_.begin(), owners_.end(), [&](const std::vector<int>& owners) {
    return std::find(owners.begin(), owners.end(), person) != owners.end();
  });
}

std::vector<std::vector<PeopleFollower::Claim>> PeopleFollower::ClaimsOn(
    const DepthImage& depth, const Pieces& pieces) const {
  std::vector<std::vector<int>> overlap(pieces.pieces.size(), std::vector<int>(people_.size(), 0));
  const auto within = static_cast<float>(settings_.following.same_place_m);
  for (std::size_t i = 0; i < people_before_.pixels().size(); ++i) {
    const int person = people_before_.pixels()[i], label = pieces.labels.pixels()[i];
    if (person == 0 || label == 0) continue;
    if (std::abs(depth.pixels()[i] - depth_before_.pixels()[i]) <= within)
      ++overlap[static_cast<std::size_t>(label - 1)][Index(person)];
  }
  std::vector<std::vector<Claim>> claims(pieces.pieces.size());
  for (std::size_t p = 0; p < overlap.size(); ++p) {
    for (std::size_t t = 0; t < people_.size(); ++t) {
      const double share =
          std::max(overlap[p][t] / static_cast<double>(std::max(1, last_[t].pixels)),
                   overlap[p][t] / static_cast<double>(pieces.pieces[p].pixels));
      if (overlap[p][t] > 0 && share >= settings_.following.claim_share)
        claims[p].push_back({static_cast<int>(t) + 1, overlap[p][t]});
    }
  }
  return claims;
}

// A small piece goes to whoever has most of it; a large one may be several people's.
void PeopleFollower::AssignByOverlap(const std::vector<std::vector<Claim>>& claims,
                                     const Pieces& pieces) {
  for (std::size_t p = 0; p < claims.size(); ++p) {
    if (claims[p].empty()) continue;
    const auto most =
        std::max_element(claims[p].begin(), claims[p].end(),
                         [](const Claim& a, const Claim& b) { return a.pixels < b.pixels; });
    owners_[p].push_back(most->person);
    for (const Claim& claim : claims[p]) {
      const bool has_much =
          claim.pixels >= settings_.following.claim_share * last_[Index(claim.person)].pixels;
      if (claim.person != most->person && has_much && pieces.pieces[p].person_sized)
        owners_[p].push_back(claim.person);
    }
  }
}

// Pieces too small for a person are assigned to a near person: for example an arm separated from
// its body by an occluder.
void PeopleFollower::AssignParts(const Pieces& pieces) {
  std::vector<std::size_t> bodies;
  for (std::size_t p = 0; p < owners_.size(); ++p) {
    if (!owners_[p].empty()) bodies.push_back(p);
  }
  for (std::size_t p = 0; p < owners_.size(); ++p) {
    if (!owners_[p].empty() || pieces.pieces[p].area_m2 >= settings_.person.size.least_area_m2)
      continue;
    float nearest = static_cast<float>(settings_.following.attach_m);
    for (const std::size_t body : bodies) {
      const float distance = Distance(pieces.pieces[p].box, pieces.pieces[body].box);
      if (distance >= nearest) continue;
      nearest = distance;
      owners_[p] = {owners_[body].front()};
    }
  }
}

// Reassigns people who moved so far that nothing overlaps, or who were hidden for some time.
void PeopleFollower::FindLostAgain(const Pieces& pieces) {
  for (int person = 1; person <= static_cast<int>(people_.size()); ++person) {
    if (IsSeenNow(person) || !IsHere(person)) continue;
    const Last& last = last_[Index(person)];
    double nearest = settings_.following.speed_m_s * (frame_ - last.frame) / fps_;
    int found = -1;
    for (std::size_t p = 0; p < owners_.size(); ++p) {
      if (!owners_[p].empty() || !pieces.pieces[p].person_sized) continue;
      const double distance = (pieces.pieces[p].box.center() - last.box.center()).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = static_cast<int>(p);
    }
    if (found >= 0) owners_[static_cast<std::size_t>(found)] = {person};
  }
}

void PeopleFollower::BeginNew(const Pieces& pieces) {
  for (std::size_t p = 0; p < owners_.size(); ++p) {
    if (!owners_[p].empty() || !pieces.pieces[p].person_sized || people_.size() >= kMostPeople)
      continue;
    people_.emplace_back();
    last_.emplace_back();
    owners_[p] = {static_cast<int>(people_.size())};
  }
}

Image<std::uint8_t> PeopleFollower::Painted(const DepthImage& depth, const Pieces& pieces) {
  Image<std::uint8_t> people(depth.width(), depth.height());
  for (std::size_t i = 0; i < people.pixels().size(); ++i) {
    const int label = pieces.labels.pixels()[i];
    if (label == 0) continue;
    const std::vector<int>& owners = owners_[static_cast<std::size_t>(label - 1)];
    if (owners.size() == 1) people.pixels()[i] = static_cast<std::uint8_t>(owners.front());
  }
  for (std::size_t p = 0; p < owners_.size(); ++p) {
    if (owners_[p].size() < 2) continue;
    Divide(pieces, static_cast<int>(p) + 1, owners_[p], people_before_, people);
    for (const int person : owners_[p]) people_[Index(person)].touching.push_back(frame_);
  }
  return people;
}

void PeopleFollower::Remember(const DepthImage& depth, const Pieces& pieces,
                              const Image<std::uint8_t>& people) {
  struct Sum {
    int pixels = 0;
    double depth_m = 0.0, squared_depth_m2 = 0.0;
  };
  std::vector<Sum> sums(people_.size());
  for (std::size_t i = 0; i < people.pixels().size(); ++i) {
    if (people.pixels()[i] == 0) continue;
    Sum& sum = sums[Index(people.pixels()[i])];
    ++sum.pixels;
    sum.depth_m += depth.pixels()[i];
    sum.squared_depth_m2 += double{depth.pixels()[i]} * depth.pixels()[i];
  }
  for (std::size_t t = 0; t < people_.size(); ++t) {
    if (sums[t].pixels == 0) continue;
    people_[t].frames.push_back(frame_);
    people_[t].areas_m2.push_back(sums[t].squared_depth_m2 / (room_.camera.fx * room_.camera.fy));
    people_[t].depths_m.push_back(sums[t].depth_m / sums[t].pixels);
    last_[t] = {frame_, sums[t].pixels, {}};
  }
  for (std::size_t p = 0; p < owners_.size(); ++p) {
    for (const int person : owners_[p]) last_[Index(person)].box.extend(pieces.pieces[p].box);
  }
  people_before_ = people;
  depth_before_ = depth;
}

Image<std::uint8_t> PeopleFollower::Follow(const DepthImage& depth, const Pieces& pieces) {
  owners_.assign(pieces.pieces.size(), {});
  AssignByOverlap(ClaimsOn(depth, pieces), pieces);
  FindLostAgain(pieces);
  BeginNew(pieces);
  AssignParts(pieces);
  Image<std::uint8_t> people = Painted(depth, pieces);
  Remember(depth, pieces, people);
  ++frame_;
  return people;
}

}  // namespace vitruvia
