// The entries of the metric catalogue (catalogue.h), by what they measure.
#pragma once

#include <vector>

#include "metrics/catalogue.h"

namespace vitruvia {

std::vector<Metric> IdentityColumns();           // which run it is
std::vector<Metric> FrameCounts();               // frames, and how many of them failed
std::vector<Metric> CorrespondingPointErrors();  // distance of corresponding surface points
std::vector<Metric> NearestPointErrors();        // distance to the nearest surface point
// Distance in both directions to a true surface that has its own triangles in each frame.
std::vector<Metric> OwnSurfaceErrors();
std::vector<Metric> ObservationErrors();  // what the camera saw against the estimate
std::vector<Metric> JointErrorMetrics();
std::vector<Metric> BoundMetrics();        // what a single frame allows
std::vector<Metric> UncertaintyMetrics();  // whether a tracker knows its error
std::vector<Metric> MotionErrors();        // how the limbs move
std::vector<Metric> BodyErrors();          // fitted bodies and scans
std::vector<Metric> Costs();               // time, effort and memory
std::vector<Metric> SolverDiagnostics();   // what the solver reports

// Texts about averages, hidden parts and lost frames that several entries share.
inline constexpr const char* kOverVertices = "the vertices of a frame, then the frames";
inline constexpr const char* kOverVisible =
    "the visible vertices of a frame, then the frames that have one";
inline constexpr const char* kOverHidden =
    "the hidden vertices of a frame, then the frames that have one";
inline constexpr const char* kOverPooledVisible =
    "the visible vertices of every n-th frame together";
inline constexpr const char* kOverPooledPoints = "the points of all frames together";
inline constexpr const char* kOverJoints = "the joints of all frames together";
inline constexpr const char* kOverStepFrames = "the frames that carried the step out";
inline constexpr const char* kFramesCount = "Lost and failed frames count like all others.";
inline constexpr const char* kAllCount =
    "Hidden parts count like visible ones, lost and failed frames like all others.";
inline constexpr const char* kSeenOnly =
    "Hidden parts are left out, and with them frames of which nothing is visible. Lost and failed "
    "frames count.";
inline constexpr const char* kHiddenOnly =
    "Visible parts are left out, and with them frames of which nothing is hidden. Lost and failed "
    "frames count.";
inline constexpr const char* kNoCorrespondence =
    "Hidden parts of the estimate are left out. Lost and failed frames count; those without "
    "measurement do not.";
inline constexpr const char* kMeasuredOnly =
    "Only what is measured counts. Lost and failed frames count; those in which the person is not "
    "measured do not.";
inline constexpr const char* kOtherViewOnly =
    "Only what the first camera does not see counts. Lost and failed frames count.";
inline constexpr const char* kJointsCount =
    "Hidden joints count like visible ones, lost and failed frames like all others; joints without "
    "a known truth do not.";
inline constexpr const char* kSeenJointsOnly =
    "Hidden joints are left out. Lost and failed frames count.";
inline constexpr const char* kHiddenJointsOnly =
    "Visible joints are left out. Lost and failed frames count.";
inline constexpr const char* kWholeBody = "There is no camera: the whole surface counts.";
inline constexpr const char* kScannedOnly = "Parts that the scan does not have are left out.";
inline constexpr const char* kWhereReported =
    "Frames for which the method reports no value are left out.";

}  // namespace vitruvia
