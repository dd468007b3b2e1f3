#include "diagnosis/cause.h"

#include <array>

namespace vitruvia {
namespace {

struct CauseText {
  std::string_view name, meaning;
};

constexpr std::array<CauseText, kCauseCount> kTexts = {{
    {"small", "The error is at most 3 cm: there is nothing to explain."},
    {"facing", "The estimate has left and right the wrong way round."},
    {"start", "The body has not been found since the first frame."},
    {"out of view", "The joint is outside the image."},
    {"hidden", "Something stands between the camera and the joint."},
    {"no data", "The frame holds no measurement."},
    {"few pairs", "Too few pixels lie on the limb."},
    {"fast", "The joint has moved far since the frame before."},
    {"noise", "The depth is noisy where the limb is."},
    {"limb on body", "The limb touches another part of the body."},
    {"lost", "The tracker has lost the body: most joints are far off."},
    {"unknown", "None of the causes that are looked for."},
}};

}  // namespace

std::string_view Name(Cause cause) { return kTexts[static_cast<std::size_t>(cause)].name; }

std::string_view Meaning(Cause cause) { return kTexts[static_cast<std::size_t>(cause)].meaning; }

}  // namespace vitruvia
