#include "experiments/cli/motion_check_text.h"

#include <fmt/format.h>

namespace vitruvia {
namespace {

const std::string& NameOf(const MocapPerformer& performer, int joint) {
  return performer.clip.joints[static_cast<std::size_t>(joint)].name;
}

// A joint of ours: where it is in the file, and where its bone's rotation comes from if elsewhere.
std::string DescribeJoint(const MocapPerformer& performer, std::size_t bone) {
  const int joint = performer.joints.joints[bone];
  const MocapBoneSource& source = performer.joints.sources[bone];
  std::string text =
      fmt::format("  {:<14} {}", Bones()[bone].joint, joint < 0 ? "-" : NameOf(performer, joint));
  if (source.from != source.to) {
    text += fmt::format(" (turns {:g} of the way from {} to {})", source.share,
                        NameOf(performer, source.from), NameOf(performer, source.to));
  } else if (source.from != joint) {
    text += fmt::format(" (turns as {})", NameOf(performer, source.from));
  }
  return text + "\n";
}

std::string DescribeLimb(const LimbLengths& limb) {
  return fmt::format("  {:<14} left {:.3f} m, right {:.3f} m, {:.1f} … {:.1f} % of its mean\n",
                     limb.name, limb.left_m, limb.right_m, 100.0 * limb.least_share,
                     100.0 * limb.most_share);
}

}  // namespace

std::string DescribePerformer(const MocapPerformer& performer) {
  const MocapClip& clip = performer.clip;
  const MocapCheck& check = performer.check;
  std::string text = fmt::format("{}\nframes:    {} at {:.4g} frames/s\n", clip.file.string(),
                                 clip.frames.size(), 1.0 / clip.frame_s);
  text += fmt::format("up:        {}; {}\n", performer.axes.up, performer.axes.evidence);
  text += fmt::format("facing:    ({:.2f}, {:.2f}, {:.2f}) in the file's axes in the first frame\n",
                      performer.facing.x(), performer.facing.y(), performer.facing.z());
  text += fmt::format("scale:     1 unit of the file is {:.5g} m (legs as long as the body's)\n",
                      performer.metres_per_unit);
  text += fmt::format("joints:    names as of {}\n", performer.joints.rig);
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) text += DescribeJoint(performer, bone);
  text += "lengths, scaled to the body:\n";
  for (const LimbLengths& limb : check.limbs) text += DescribeLimb(limb);
  text += fmt::format("  {:<14} {:.3f} m from the hips\n", "head joint", check.trunk_m);
  text += fmt::format("head:      above the feet in {:.0f} % of the frames\n",
                      100.0 * check.head_above_feet);
  text += fmt::format("knees:     {} of {} that are bent bend backwards\n", check.knees_backwards,
                      check.bent_knees);
  text += fmt::format("speed:     the hips move at most {:.2f} m/s, after frame {}\n",
                      check.fastest_m_s, check.fastest_frame + 1);
  for (const std::string& note : clip.notes) text += fmt::format("note: {}\n", note);
  return text;
}

}  // namespace vitruvia
