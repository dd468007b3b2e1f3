#include "learning/scan/body_check.h"

#include <algorithm>

#include "core/error.h"

namespace vitruvia {

void BodyCheckSettings::Describe(Fields& f) {
  f.Number("min_area_m2", min_area_m2,
           {.meaning = "minimum area of a surface that counts as a body",
            .unit = "m²",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kGuessed,
            .source = "an adult has 1.4 m² and more"});
  f.Number("second_body_share", second_body_share,
           {.meaning = "a second piece with this share of the largest one's area is a second body",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "a leg has 0.18 of a body's surface"});
  f.Number("head_reach_m", head_reach_m,
           {.meaning = "distance from the top within which a hole counts as a missing head",
            .unit = "m",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "above the chin: what lies below may be hidden by it"});
  f.Number("max_head_hole_m2", max_head_hole_m2,
           {.meaning = "an opening near the top that is larger than this counts as a missing head",
            .unit = "m²",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kGuessed,
            .source = "a neck's section has 0.008 m² and more, a crown seen from the side 0.005"});
}

void RequireOneWholeBody(const ScanSurface& surface, const BodyCheckSettings& settings) {
  const std::vector<SurfaceComponent>& found = surface.components;
  const double area_m2 = found.empty() ? 0.0 : found.front().area_m2;
  if (area_m2 < settings.min_area_m2) {
    throw DataError(fmt::format(
        "scan: no body: the largest surface found has {:.3f} m², expected at least {:g} m²",
        area_m2, settings.min_area_m2));
  }
  if (found.size() > 1 && found[1].area_m2 >= settings.second_body_share * area_m2) {
    const Vector3f a = found[0].box.center();
    const Vector3f b = found[1].box.center();
    throw DataError(fmt::format(
        "scan: two bodies: surfaces of {:.2f} m² round ({:.2f}, {:.2f}, {:.2f}) and of {:.2f} m² "
        "round ({:.2f}, {:.2f}, {:.2f}); expected one",
        area_m2, a.x(), a.y(), a.z(), found[1].area_m2, b.x(), b.y(), b.z()));
  }
  float top = found.front().box.min().y();
  for (const Vector3f& p : surface.mesh.vertices) top = std::max(top, p.y());
  for (const BoundaryLoop& hole : surface.holes) {
    if (hole.center.y() < top - static_cast<float>(settings.head_reach_m) ||
        hole.area_m2 <= settings.max_head_hole_m2) {
      continue;
    }
    throw DataError(fmt::format(
        "scan: a hole for a head: at a height of {:.2f} m, {:.2f} m below the top, the surface has "
        "an opening of {:.4f} m²; expected at most {:g} m²",
        hole.center.y(), top - hole.center.y(), hole.area_m2, settings.max_head_hole_m2));
  }
}

}  // namespace vitruvia
