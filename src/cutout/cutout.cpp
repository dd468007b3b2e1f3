#include "cutout/cutout.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "cutout/touching.h"
#include "geometry/mask_png.h"
#include "math/statistics.h"

namespace vitruvia {
namespace {

const FollowedPerson& Person(const std::vector<FollowedPerson>& people, int number) {
  return people[static_cast<std::size_t>(number - 1)];
}

// Numbers of people, in descending order of preference.
std::vector<int> Ranked(const std::vector<FollowedPerson>& people, PersonChoice choose) {
  std::vector<int> order;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (!people[i].frames.empty()) order.push_back(static_cast<int>(i) + 1);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    if (choose == PersonChoice::kNearest)
      return Person(people, a).MeanDepth() < Person(people, b).MeanDepth();
    return Person(people, a).TotalArea() > Person(people, b).TotalArea();
  });
  return order;
}

// The chosen person's area in each frame; 0 where they are not seen.
std::vector<double> AreasOf(const std::vector<FollowedPerson>& people, const ChosenPerson& chosen,
                            std::size_t frames) {
  std::vector<double> areas(frames, 0.0);
  for (const int number : chosen.numbers) {
    const FollowedPerson& person = Person(people, number);
    for (std::size_t i = 0; i < person.frames.size(); ++i)
      areas[static_cast<std::size_t>(person.frames[i])] += person.areas_m2[i];
  }
  return areas;
}

// The median area of the neighbouring frames, without this frame and without empty ones; 0 if there
// are none.
double AreaRound(const std::vector<double>& areas, std::size_t frame, int window) {
  const auto reach = static_cast<std::size_t>(window);
  std::vector<double> near;
  for (std::size_t i = frame > reach ? frame - reach : 0;
       i < std::min(areas.size(), frame + reach + 1); ++i) {
    if (i != frame && areas[i] > 0.0) near.push_back(areas[i]);
  }
  return near.empty() ? 0.0 : Quantile(near, 0.5);
}

}  // namespace

Pieces PiecesOf(const DepthImage& depth, const Room& room, const CutoutSettings& settings) {
  Pieces pieces = FindPieces(depth, ForegroundOf(depth, room, settings), room, settings);
  DivideTouchingPeople(depth, room, settings, pieces);
  return pieces;
}

std::optional<ChosenPerson> ChoosePerson(const std::vector<FollowedPerson>& people,
                                         const PersonSettings& settings, int at_pixel) {
  std::vector<int> order = Ranked(people, settings.choose);
  if (settings.choose == PersonChoice::kPixel) {
    if (at_pixel == 0) return std::nullopt;
    std::stable_partition(order.begin(), order.end(), [&](int n) { return n == at_pixel; });
  }
  if (order.empty()) return std::nullopt;
  ChosenPerson chosen;
  for (const int number : order) {
    const bool apart = std::none_of(chosen.numbers.begin(), chosen.numbers.end(), [&](int other) {
      return Person(people, number).OverlapsInTime(Person(people, other));
    });
    if (apart) chosen.numbers.push_back(number);
  }
  return chosen;
}

MaskImage MaskOf(const OutlinedPeople& outlined, const ChosenPerson& chosen) {
  std::array<std::uint8_t, 256> value{};
  for (const int number : chosen.numbers) value[static_cast<std::size_t>(number)] = kSubjectMask;
  const Image<std::uint8_t>& people = outlined.people;
  MaskImage mask(people.width(), people.height());
  for (std::size_t i = 0; i < mask.pixels().size(); ++i)
    mask.pixels()[i] = value[people.pixels()[i]];
  for (const int i : outlined.foreign_depth) {
    std::uint8_t& pixel = mask.pixels()[static_cast<std::size_t>(i)];
    if (pixel != 0) pixel = kForeignDepthMask;
  }
  return mask;
}

void CutoutReport::AddUnsure(int frame, const std::string& why) {
  const auto at =
      std::lower_bound(unsure.begin(), unsure.end(), frame,
                       [](const UnsureFrame& other, int number) { return other.frame < number; });
  if (at == unsure.end() || at->frame != frame)
    unsure.insert(at, {frame, why});
  else
    at->why += "; " + why;
}

CutoutReport ReportCutout(const std::vector<FollowedPerson>& people, const ChosenPerson& chosen,
                          const std::vector<double>& pixel_shares,
                          const FollowingSettings& settings) {
  const std::vector<double> areas = AreasOf(people, chosen, pixel_shares.size());
  std::map<int, std::string> why;
  CutoutReport report;
  report.frames = static_cast<int>(pixel_shares.size());
  std::vector<double> seen_areas, seen_shares;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (areas[i] == 0.0) {
      ++report.frames_without_person;
      why[static_cast<int>(i)] = "the person is not seen";
      continue;
    }
    seen_areas.push_back(areas[i]);
    seen_shares.push_back(pixel_shares[i]);
    const double near = AreaRound(areas, i, settings.area_window);
    if (near == 0.0 ||
        (areas[i] <= near * settings.area_factor && areas[i] >= near / settings.area_factor))
      continue;
    ++report.area_jumps;
    why[static_cast<int>(i)] =
        fmt::format("area {:.2f} m², {:.2f} m² in the frames round it", areas[i], near);
  }
  for (const int number : chosen.numbers) {
    for (const int frame : Person(people, number).touching) {
      std::string& reason = why[frame];
      reason += reason.empty() ? "somebody else touches the person"
                               : "; somebody else touches the person";
    }
  }
  if (!seen_areas.empty()) report.area_m2 = Quantile(seen_areas, 0.5);
  report.pixel_share = Mean(seen_shares);
  for (auto& [frame, reason] : why) report.unsure.push_back({frame, std::move(reason)});
  return report;
}

}  // namespace vitruvia
