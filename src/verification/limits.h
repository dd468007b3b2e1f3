// All thresholds of the verification. Warnings allow for unusual but intended data; errors are set
// so that only a wrong unit, frame, order or file can reach them.
#pragma once

namespace vitruvia::verification_limits {

// Camera.
inline constexpr double kNarrowestView_deg = 20.0, kWidestView_deg = 120.0;  // of the wider side
inline constexpr double kLargestPixelAspect = 1.2;                           // fx / fy, either way
inline constexpr double kPrincipalPointMargin = 0.25;   // minimum distance from the image border,
                                                        // share of the image
inline constexpr double kOtherResolutionWithin = 0.02;  // of (size − 1) / 2, relative

// Subject.
inline constexpr double kSmallestBody_m = 0.7, kLargestBody_m = 4.0;  // diagonal of the T-pose
inline constexpr double kDiagonalOfHeight = 1.43;     // diagonal of a T-pose / height
inline constexpr double kSkeletonOfMeshLeast = 0.75;  // diagonal of the bones / of the mesh
inline constexpr double kSkeletonOfMeshMost = 1.2;
inline constexpr double kHeightErrorAbove = 0.15;  // |mesh height / height_m − 1|
inline constexpr double kHeightWarningAbove = 0.05;
inline constexpr double kFloorWithin_m = 0.05;       // lowest vertex from y = 0
inline constexpr double kAxisAlignment = 0.7;        // cosine between a body axis and its frame's
inline constexpr double kSkinFromBone = 0.15;        // of the height: distance of a bone's skin
                                                     // from the bone's midpoint
inline constexpr double kBonesWithTheirSkin = 0.75;  // share of the bones
inline constexpr double kJointsInside = 0.6;         // share of the joints inside the mesh

// Rest pose of the true surface against the subject.
inline constexpr double kRestMedianWithin_m = 0.06;
inline constexpr double kRestNearlyAllWithin_m = 0.16;  // 95 % of the vertices
inline constexpr double kRestScaleWithin = 0.12;        // ratio of the diagonals
inline constexpr double kTurnedRestError_m = 0.004;     // mean distance above which rotations are
                                                        // tried

// True surface.
inline constexpr double kEdgeScaleWithin = 0.25;  // median edge, posed / rest
inline constexpr double kEdgesKeptShare = 0.7;    // of edges within a factor 2 of the median
inline constexpr double kStrayEdge_m = 0.5;       // of one edge, posed …
inline constexpr double kStrayEdgeRatio = 10.0;   // … and this many times its length at rest
inline constexpr double kVolumeShare = 0.2;       // minimum |posed / rest| of the signed volume

// True joints.
inline constexpr double kBoneErrorFactor = 2.0;  // median bone / the subject's
inline constexpr double kBoneWarningFactor = 1.25;
inline constexpr double kBoneVariation = 0.35;        // (95 % − 5 %) / median of one bone
inline constexpr double kFastestBody_m_s = 15.0;      // mean of all joints
inline constexpr double kJump_m = 0.10;               // mean step of all joints …
inline constexpr double kJumpOfNeighbours = 4.0;      // … and of the steps before and after
inline constexpr double kJointFromSkin_m = 0.10;      // more than in the rest pose
inline constexpr double kJointsOnSurface = 0.8;       // share of joints in their place
inline constexpr double kJointOfSkin_m = 0.06;        // distance from the place to which the
                                                      // surrounding skin moves it
inline constexpr double kJointsOffSkin = 0.1;         // share of joints that may be farther
inline constexpr double kSidewaysShoulders_m = 0.05;  // below it the direction of facing is
                                                      // undetermined
inline constexpr double kUprightCosine = 0.7;         // first frame

// Depth images.
inline constexpr double kEmptyFramesShare = 0.5;
inline constexpr int kFewPixels = 20;       // images with fewer are not judged
inline constexpr long kEnoughPixels = 200;  // minimum number of pixels for a constant image to be a
                                            // fault
inline constexpr double kSwappedBytesRoughness = 10.0;  // raw / swapped, of neighbours' differences
inline constexpr double kRepeatedMotion_m = 0.03;       // of the truth during a repeated image

// Depth against truth.
inline constexpr float kAgreeWithin_m = 0.10f;
inline constexpr double kAgreeingShare = 0.5;       // of pixels that both have
inline constexpr double kCoveredShare = 0.3;        // of the true surface's pixels
inline constexpr double kFrameAgreeingShare = 0.1;  // of one frame …
inline constexpr double kFrameSilhouette = 0.8;     // … whose outlines agree this well
inline constexpr double kFrameRatio = 1.25;         // … and whose depths differ by this
inline constexpr double kMirrorVotes = 1.5;         // votes for the mirror image / against
inline constexpr long kMirrorFewestVotes = 100;
inline constexpr double kDepthRatioWarning = 0.03;
inline constexpr double kOutlineScaleWarning = 0.06;    // and …
inline constexpr double kOutlineEdgeWarning_px = 1.25;  // … more than a sensor loses at an edge
inline constexpr double kOutlineShiftWarning = 0.04;    // of the image's width
inline constexpr double kJointBehindDepth_m = 0.40;     // depth before a joint, at most
inline constexpr double kDepthBehindJoint_m = 0.10;     // depth behind a joint, at most
inline constexpr double kCauseScore = 0.5;              // a cause explains this share of pixels
inline constexpr double kCauseGain = 2.0;               // and this many times what is stated
inline constexpr double kNearestBody_m = 0.2, kFarthestBody_m = 20.0;  // median depth
inline constexpr double kApparentSize = 1.6;  // cloud / subject, either way

// Each image against the truth of its own frame.
inline constexpr float kSameMomentWithin_m = 0.05f;
inline constexpr float kBeforeSurface_m = 0.15f;  // another object stands in front of the person
inline constexpr double kUsualDifference = 2.0;   // times the share of a usual frame …
inline constexpr double kFrameDifference = 0.10;  // … and this share of the pixels more
inline constexpr long kFewDifferingPixels = 40;
inline constexpr double kWrongFlags = 0.25;  // of the joints for which the images determine
                                             // visibility
inline constexpr int kFewestFlags = 20;

// Number of frames checked before a run, so that the check takes a few percent of the run's time,
// and number of frames used to find the cause of a disagreement.
inline constexpr int kFramesPerSample = 40;  // one of so many frames is checked before a run …
inline constexpr int kFewestSampledFrames = 3, kMostSampledFrames = 8;  // … within these
inline constexpr int kFramesForCause = 4;

}  // namespace vitruvia::verification_limits
