#include "synth/motions/mocap_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "math/angles.h"
#include "synth/motions/mocap_figure.h"

namespace vitruvia {
namespace {

using Vector3d = Vector3<double>;
using Matrix3d = Matrix3<double>;
using enum BoneId;

// A direction this near to a coordinate axis is meant to be that axis.
constexpr double kOnAxisDeg = 20.0;
// A body points along an axis if its head lies that near to it, as seen from the feet and from the
// hips: not that of somebody who sits.
constexpr double kAlongAxisDeg = 40.0;
// Share of the frames that must agree on an axis against the rest pose's.
constexpr double kClearShare = 0.8;
// Where the rest pose says nothing: of the frames in which the body points along any axis.
constexpr double kSimpleShare = 0.5;
// In leg lengths: how high the hips of somebody who stands are above the floor, and how far from
// the floor a joint may be that rests on it.
constexpr double kHipsLowest = 0.7, kHipsHighest = 1.3, kOffFloor = 0.25;

constexpr std::array<const char*, 6> kAxisNames{"+x", "-x", "+y", "-y", "+z", "-z"};

Vector3d Axis(std::size_t index) {
  return (index % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(static_cast<Eigen::Index>(index / 2));
}

std::size_t NearestAxis(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return 2 * static_cast<std::size_t>(axis) + (std::signbit(direction[axis]) ? 1 : 0);
}

bool IsAlong(const Vector3d& direction, const Vector3d& axis, double within_deg) {
  return direction.norm() > 0.0 &&
         direction.normalized().dot(axis.normalized()) > std::cos(kRadiansPerDegree * within_deg);
}

Vector3d OnAxisIfNear(const Vector3d& direction) {
  const Vector3d axis = Axis(NearestAxis(direction));
  return IsAlong(direction, axis, kOnAxisDeg) ? axis : direction.normalized();
}

std::string Text(const Vector3d& direction) {
  const std::size_t axis = NearestAxis(direction);
  if (IsAlong(direction, Axis(axis), 0.5)) return kAxisNames[axis];
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", direction.x(), direction.y(), direction.z());
}

// Evidence of the frames about the world's axes.
struct FrameEvidence {
  std::vector<std::vector<Vector3d>> positions;  // of all joints in every frame
  std::array<double, 6> shares{};            // of frames with the head above the feet along an axis
  std::vector<std::string> figure_problems;  // "" for frames of a standing figure

  std::size_t BestAxis() const {
    return static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin());
  }
  std::string Text() const {
    std::string text;
    for (std::size_t axis = 0; axis < shares.size(); ++axis) {
      if (shares[axis] == 0.0) continue;
      text += fmt::format("{}{} in {:.0f} %", text.empty() ? "" : ", ", kAxisNames[axis],
                          100.0 * shares[axis]);
    }
    return text.empty() ? "no axis in any frame" : text;
  }
};

FrameEvidence LookAtFrames(const MocapClip& clip, const MocapJoints& joints) {
  FrameEvidence seen;
  for (const MocapFrame& frame : clip.frames) {
    seen.positions.push_back(PoseOf(clip, frame).positions);
    const std::vector<Vector3d>& at = seen.positions.back();
    const auto middle = [&](BoneId a, BoneId b) -> Vector3d {
      return 0.5 * (at[joints.At(a)] + at[joints.At(b)]);
    };
    const Vector3d up = at[joints.At(kHead)] - middle(kLeftFoot, kRightFoot);
    const Vector3d trunk = at[joints.At(kHead)] - middle(kLeftThigh, kRightThigh);
    const std::size_t axis = NearestAxis(up);
    if (IsAlong(up, Axis(axis), kAlongAxisDeg) && IsAlong(trunk, Axis(axis), kAlongAxisDeg)) {
      seen.shares[axis] += 1.0;
    }
    seen.figure_problems.push_back(FigureProblem(at, joints));
  }
  for (double& share : seen.shares) share /= static_cast<double>(clip.frames.size());
  return seen;
}

template <class Holds>
double ShareOfFrames(const FrameEvidence& seen, Holds&& holds) {
  const auto count = std::ranges::count_if(seen.positions, holds);
  return static_cast<double>(count) / static_cast<double>(seen.positions.size());
}

// Share of the frames in which somebody stands on a floor at 0, if `up` is up.
double ShareStandingOnFloor(const FrameEvidence& seen, const MocapJoints& joints,
                            const Vector3d& up, double leg) {
  return ShareOfFrames(seen, [&](const std::vector<Vector3d>& at) {
    const auto height = [&](BoneId bone) { return at[joints.At(bone)].dot(up) / leg; };
    const double hips = 0.5 * (height(kLeftThigh) + height(kRightThigh));
    const double ankle = std::min(height(kLeftFoot), height(kRightFoot));
    return hips > kHipsLowest && hips < kHipsHighest && std::abs(ankle) < kOffFloor;
  });
}

// Share of the frames in which the lowest joint is near a floor at 0, if `up` is up.
double ShareOnFloor(const FrameEvidence& seen, const MocapJoints& joints, const Vector3d& up,
                    double leg) {
  return ShareOfFrames(seen, [&](const std::vector<Vector3d>& at) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const int joint : joints.joints) {
      if (joint >= 0) lowest = std::min(lowest, at[static_cast<std::size_t>(joint)].dot(up) / leg);
    }
    return std::abs(lowest) < kOffFloor;
  });
}

FigureAxes RestFigureAxes(const std::vector<Vector3d>& rest, const MocapJoints& joints) {
  const Vector3d up = OnAxisIfNear(LegsUp(rest, joints));
  const Vector3d left = HipsLeft(rest, joints);
  return AxesFrom(OnAxisIfNear(left - left.dot(up) * up), up);
}

// The world's axes with `up`; left is where it is in the first frame, which is turned to the front
// anyway.
Matrix3d WorldAxes(const Vector3d& up, const FrameEvidence& seen, const MocapJoints& joints) {
  Vector3d left = HipsLeft(seen.positions[0], joints);
  left -= left.dot(up) * up;
  if (!(left.norm() > 0.0)) left = up.unitOrthogonal();
  return AxesFrom(left, up).Rows();
}

std::optional<Vector3d> Stated(UpAxis up_axis) {
  if (up_axis == UpAxis::kFromFile) return {};
  return Axis(static_cast<std::size_t>(up_axis) - 1);
}

class AxesFinder {
 public:
  AxesFinder(MocapClip& clip, const MocapJoints& joints, UpAxis up_axis)
      : clip_(clip),
        joints_(joints),
        stated_up_(Stated(up_axis)),
        seen_(LookAtFrames(clip, joints)),
        rest_(RestPositions(clip)),
        rest_problem_(FigureProblem(rest_, joints)) {}

  MocapAxes Find() {
    if (!(LegLength(rest_, joints_) > 0.0)) Fail("the legs have no length");
    return rest_problem_.empty() ? FromRestPose() : FromFrames();
  }

 private:
  [[noreturn]] void Fail(const std::string& problem) const {
    throw DataError(fmt::format("{}: {}", clip_.file.string(), problem));
  }

  std::string HeadOverFeet() const {
    return fmt::format("in the frames the head is above the feet along {}", seen_.Text());
  }

  MocapAxes FromRestPose() const {
    const FigureAxes rest = RestFigureAxes(rest_, joints_);
    const std::string evidence =
        fmt::format("the rest pose stands upright along {}; {}", Text(rest.up), HeadOverFeet());
    const auto [up, warning] = WorldUp(rest.up, evidence);
    const Matrix3d world = up == rest.up ? rest.Rows() : WorldAxes(up, seen_, joints_);
    return {world, rest.Rows(), Text(up), evidence, warning};
  }

  struct Up {
    Vector3d direction;
    std::string warning;
  };

  // Up in the world, given what is up in the rest pose. If the two differ, the person lies or
  // stands on the hands, or the rest pose is in different axes from the world; the floor, which is
  // at 0 in most files, decides between these cases.
  Up WorldUp(const Vector3d& rest_up, const std::string& evidence) const {
    if (stated_up_) return {*stated_up_, ""};
    const std::size_t best = seen_.BestAxis();
    const Vector3d frames_up = Axis(best);
    if (seen_.shares[best] < kClearShare || IsAlong(rest_up, frames_up, kAlongAxisDeg)) {
      return {rest_up, ""};
    }
    const double leg = LegLength(rest_, joints_);
    const double stands = ShareStandingOnFloor(seen_, joints_, frames_up, leg);
    if (stands >= kClearShare) return {frames_up, ""};
    const double lies = ShareOnFloor(seen_, joints_, rest_up, leg);
    const std::string counts = fmt::format(
        "{}. With {} up, the performer stands on a floor at 0 in {:.0f} % of the frames; with {} "
        "up, the lowest joint is there in {:.0f} %",
        evidence, kAxisNames[best], 100.0 * stands, Text(rest_up), 100.0 * lies);
    if (lies < kClearShare) {
      Fail(fmt::format("cannot tell which way is up: {}. Set the motion's up_axis", counts));
    }
    return {rest_up, fmt::format("{} is taken to be up, so the performer does not stand: {}. If "
                                 "that is not so, set the motion's up_axis",
                                 Text(rest_up), counts)};
  }

  MocapAxes FromFrames() {
    const Vector3d up = UpOfStandingFrames();
    const std::size_t reference = ReferenceFrame(up);
    const FigureAxes axes = AxesFrom(HipsLeft(seen_.positions[reference], joints_), up);
    TakeAsRestPose(clip_, reference);
    const std::string replaced = fmt::format(
        "the file's rest pose is no upright figure ({}); frame {} of {}, the one nearest to a "
        "standing T-pose, takes its place",
        rest_problem_, reference + 1, clip_.frames.size());
    return {axes.Rows(), axes.Rows(), Text(up), fmt::format("{}; {}", replaced, HeadOverFeet()),
            replaced + ": twists of trunk and limbs are counted from there"};
  }

  Vector3d UpOfStandingFrames() const {
    if (stated_up_) return *stated_up_;
    const std::size_t best = seen_.BestAxis();
    const double along_any = std::accumulate(seen_.shares.begin(), seen_.shares.end(), 0.0);
    if (along_any > 0.0 && seen_.shares[best] >= kSimpleShare * along_any) return Axis(best);
    Fail(
        fmt::format("cannot tell which way is up: the rest pose is no upright figure ({}), and {}; "
                    "expected one axis in at least {:g} % of those. Set the motion's up_axis",
                    rest_problem_, HeadOverFeet(), 100.0 * kSimpleShare));
  }

  // The standing figure nearest to a T-pose; the first of equals.
  std::size_t ReferenceFrame(const Vector3d& up) const {
    std::optional<std::size_t> best;
    double best_likeness = 0.0;
    for (std::size_t i = 0; i < seen_.positions.size(); ++i) {
      const std::vector<Vector3d>& at = seen_.positions[i];
      if (!seen_.figure_problems[i].empty()) continue;
      if (!IsAlong(LegsUp(at, joints_), up, kAlongAxisDeg)) continue;
      const double likeness = TPoseLikeness(at, joints_);
      if (best && likeness <= best_likeness + 1e-9) continue;
      best = i;
      best_likeness = likeness;
    }
    if (best) return *best;
    Fail(fmt::format(
        "the rest pose is no upright figure ({}), and none of {} frames is, with up along {}, that "
        "could take its place: bones cannot be told apart from their rotations. In frame 1: {}",
        rest_problem_, clip_.frames.size(), Text(up),
        seen_.figure_problems[0].empty() ? "the performer does not stand along that axis"
                                         : seen_.figure_problems[0]));
  }

  MocapClip& clip_;
  const MocapJoints& joints_;
  std::optional<Vector3d> stated_up_;
  FrameEvidence seen_;
  std::vector<Vector3d> rest_;
  std::string rest_problem_;
};

}  // namespace

void DescribeUpAxis(Fields& f, UpAxis& up_axis) {
  f.Choice("up_axis", up_axis,
           {{"from_file", UpAxis::kFromFile},
            {"+x", UpAxis::kPlusX},
            {"-x", UpAxis::kMinusX},
            {"+y", UpAxis::kPlusY},
            {"-y", UpAxis::kMinusY},
            {"+z", UpAxis::kPlusZ},
            {"-z", UpAxis::kMinusZ}},
           {.meaning = "up axis of the motion capture file's world; from_file: the axis along "
                       "which the rest pose stands upright or, if it does not, along which the "
                       "head is above the feet in most frames"});
}

void TakeAsRestPose(MocapClip& clip, std::size_t frame) {
  const MocapPose rest = PoseOf(clip, clip.frames[frame]);
  std::vector<Eigen::Quaterniond> world_from_rest;
  for (const Matrix3d& rotation : rest.rotations) world_from_rest.emplace_back(rotation);
  for (MocapFrame& moved : clip.frames) {
    for (std::size_t i = 0; i < clip.joints.size(); ++i) {
      // A joint's rotation from the world becomes G(t) G(rest)⁻¹: before it, its parent's is
      // undone.
      const int parent = clip.joints[i].parent;
      const Eigen::Quaterniond own = moved.rotations[i] * world_from_rest[i].conjugate();
      if (parent < 0) {
        moved.rotations[i] = own;
        continue;
      }
      const Eigen::Quaterniond& of_parent = world_from_rest[static_cast<std::size_t>(parent)];
      moved.rotations[i] = of_parent * own;
      if (!moved.offsets.empty()) moved.offsets[i] = of_parent * moved.offsets[i];
    }
  }
  for (std::size_t i = 0; i < clip.joints.size(); ++i) {
    MocapJoint& joint = clip.joints[i];
    joint.tip = world_from_rest[i] * joint.tip;
    if (joint.parent < 0) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    joint.offset = rest.positions[i] - rest.positions[parent];
  }
}

MocapAxes FindAxes(MocapClip& clip, const MocapJoints& joints, UpAxis up_axis) {
  return AxesFinder(clip, joints, up_axis).Find();
}

}  // namespace vitruvia
