#include "body/joint_limits.h"

namespace vitruvia {
namespace {

// Ranges of motion: American Academy of Orthopaedic Surgeons, "Joint Motion: Method of Measuring
// and Recording" (1965), and the American Medical Association's "Guides to the Evaluation of
// Permanent Impairment", both as tabulated in Norkin & White, "Measurement of Joint Motion: A Guide
// to Goniometry"; the wider where the two differ.
constexpr const char* kAaos = "AAOS 1965";
constexpr const char* kAma = "AMA Guides";

constexpr std::array<AngleInfo, 3> kSpine{{
    {"flexion_deg", "bends the trunk forward", -30.0, 80.0, kAaos},
    {"bend_left_deg", "bends the trunk to the subject's left", -35.0, 35.0, kAaos},
    {"turn_left_deg", "turns the trunk to the subject's left", -45.0, 45.0, kAaos},
}};
constexpr std::array<AngleInfo, 3> kNeckAngles{{
    {"flexion_deg", "bends the head forward", -60.0, 50.0, kAma},
    {"bend_left_deg", "bends the head to the subject's left", -45.0, 45.0, kAaos},
    {"turn_left_deg", "turns the head to the subject's left", -80.0, 80.0, kAma},
}};
constexpr std::array<AngleInfo, 3> kShoulder{{
    {"flexion_deg", "swings the arm forward and up", -60.0, 180.0, kAaos},
    {"abduction_deg", "swings the arm sideways and up, across the chest if negative", -65.0, 180.0,
     "AAOS 1965; negative: horizontal flexion of 135 degrees"},
    {"internal_rotation_deg", "turns the arm's front towards the body", -90.0, 90.0,
     "AAOS 1965: outward 90, inward 70; AMA Guides: inward 90"},
}};
constexpr std::array<AngleInfo, 2> kElbow{{
    {"flexion_deg", "brings the hand towards the shoulder", 0.0, 150.0, kAaos},
    {"pronation_deg", "turns a hanging hand's palm to the back", -80.0, 80.0, kAaos},
}};
constexpr std::array<AngleInfo, 2> kWrist{{
    {"flexion_deg", "bends the hand towards the palm", -90.0, 80.0,
     "AAOS 1965: extension 70; 90 where the body's weight rests on the palm"},
    {"ulnar_deviation_deg", "bends the hand towards the little finger", -20.0, 30.0, kAaos},
}};
constexpr std::array<AngleInfo, 3> kHip{{
    {"flexion_deg", "swings the thigh forward and up", -30.0, 120.0, kAaos},
    {"abduction_deg", "swings the thigh sideways", -30.0, 45.0, kAaos},
    {"internal_rotation_deg", "turns the thigh's front towards the middle", -45.0, 45.0, kAaos},
}};
constexpr std::array<AngleInfo, 1> kKnee{{
    {"flexion_deg", "brings the heel towards the seat", 0.0, 150.0, kAma},
}};
constexpr std::array<AngleInfo, 2> kAnkle{{
    {"dorsiflexion_deg", "lifts the toes", -50.0, 20.0, kAaos},
    {"inversion_deg", "turns the sole towards the other foot", -15.0, 35.0, kAaos},
}};

constexpr std::array<JointInfo, 2> kMidlineJoints{{
    {"spine", "", kSpineFlexion, kSpine},
    {"neck", "", kNeckFlexion, kNeckAngles},
}};
constexpr std::array<JointInfo, 6> kSideJoints{{
    {"shoulder", "shoulders", kShoulderFlexion, kShoulder},
    {"elbow", "elbows", kElbowFlexion, kElbow},
    {"wrist", "wrists", kWristFlexion, kWrist},
    {"hip", "hips", kHipFlexion, kHip},
    {"knee", "knees", kKneeFlexion, kKnee},
    {"ankle", "ankles", kDorsiflexion, kAnkle},
}};

}  // namespace

std::span<const JointInfo> MidlineJoints() { return kMidlineJoints; }
std::span<const JointInfo> SideJoints() { return kSideJoints; }

}  // namespace vitruvia
