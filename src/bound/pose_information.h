// The Fisher information of one depth frame about a body's pose, and the bound that follows.
//
//   I(θ) = Σ over the pixels of the true rendering of Jᵀ n nᵀ J / (c² σ_z² + (1 − c²) σ_l²) + prior
//
// J is the motion of the surface point that the pixel shows with the pose θ, n the surface's normal
// and c its cosine with the line of sight; σ_z and σ_l are the sensor's deviations along and across
// it. No unbiased estimate of θ from this frame alone has a smaller covariance than I⁻¹ (Cramér and
// Rao), and none of a joint a smaller one than G I⁻¹ Gᵀ, where G is the joint's motion with θ. The
// bound knows the body's shape exactly; it knows nothing of the frames before, so that a tracker
// with memory may pass it.
//
// The pose: a translation of the body, and a rotation vector of each bone about its proximal joint,
// camera frame. A surface point follows the rotation of joint j by the sum of its weights of the
// bones below j, which is exact where these bones agree on the point's place and off by the share
// of their disagreement elsewhere.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "body/body_model.h"
#include "bound/pose_prior.h"
#include "bound/surface_samples.h"
#include "synth/sensor/expected_noise.h"

namespace vitruvia {

inline constexpr int kPoseUnknowns = 3 + 3 * kBoneCount;

// For each vertex and joint: the share of the joint's rotation that the vertex follows.
using RotationShares = std::vector<std::array<float, kBoneCount>>;
RotationShares SharesOf(const SkinWeights& weights);

// Weights for a surface that is not the subject's own: each vertex takes those of the nearest place
// of the subject's rest surface.
SkinWeights TransferredWeights(const BodyModel& subject,
                               const std::vector<Vector3f>& rest_vertices);

// A body as it truly is in a frame, camera frame.
struct TrueBody {
  const std::vector<Vector3f>& vertices;
  const std::vector<Triangle>& triangles;
  const RotationShares& shares;
  const std::array<Vector3d, kBoneCount>& joints;
};

// Σ over the pixels. Noise that is shared over an area of pixels counts once for each area.
Eigen::MatrixXd PoseInformation(const TrueBody& body, const Image<SurfaceSample>& samples,
                                const Image<PixelNoise>& noise, const PinholeCamera& camera,
                                double shared_area_px);
Eigen::MatrixXd PriorInformation(const PosePrior& prior);

// The smallest covariance of each joint's position, m².
std::array<Matrix3<double>, kBoneCount> JointBounds(const Eigen::MatrixXd& information,
                                                    const std::array<Vector3d, kBoneCount>& joints);

// The motion of a joint's position with the pose, 3 × kPoseUnknowns.
Eigen::MatrixXd JointMotion(int joint, const std::array<Vector3d, kBoneCount>& joints);

}  // namespace vitruvia
