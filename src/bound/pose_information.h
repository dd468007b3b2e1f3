// The Fisher information of one depth frame about a body's pose, and the resulting Cramér–Rao
// bound.
//
//   I(θ) = Σ over the pixels of the true rendering of Jᵀ n nᵀ J / (c² σ_z² + (1 − c²) σ_l²) + prior
//
// J is the derivative with respect to the pose θ of the surface point that the pixel shows, n the
// surface normal, and c the cosine between n and the line of sight; σ_z and σ_l are the sensor's
// standard deviations along and across that line. No unbiased estimate of θ from this frame alone
// has a smaller covariance than I⁻¹ (Cramér and Rao), and no such estimate of a joint has a smaller
// covariance than G I⁻¹ Gᵀ, where G is the joint's derivative with respect to θ. The bound assumes
// that the body's shape is known exactly. It does not use earlier frames, so a tracker that does
// may be better than the bound.
//
// The pose: a translation of the body, and a rotation vector of each bone about its proximal joint,
// camera frame. A surface point follows the rotation of joint j with the sum of its skinning
// weights for the bones below j. This is exact where these bones place the point identically, and
// approximate elsewhere.
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

// Weights for a surface other than the subject's: each vertex takes those of the closest point of
// the subject's rest surface.
SkinWeights TransferredWeights(const BodyModel& subject,
                               const std::vector<Vector3f>& rest_vertices);

// The true body in a frame, camera frame.
struct TrueBody {
  const std::vector<Vector3f>& vertices;
  const std::vector<Triangle>& triangles;
  const RotationShares& shares;
  const std::array<Vector3d, kBoneCount>& joints;
};

// The sum over the pixels, without the prior. Noise that is common to an area of pixels counts once
// for each area.
Eigen::MatrixXd PoseInformation(const TrueBody& body, const Image<SurfaceSample>& samples,
                                const Image<PixelNoise>& noise, const PinholeCamera& camera,
                                double shared_area_px);
Eigen::MatrixXd PriorInformation(const PosePrior& prior);

// The smallest covariance of each joint's position, m².
std::array<Matrix3<double>, kBoneCount> JointBounds(const Eigen::MatrixXd& information,
                                                    const std::array<Vector3d, kBoneCount>& joints);

// Derivative of a joint's position with respect to the pose, 3 × kPoseUnknowns.
Eigen::MatrixXd JointMotion(int joint, const std::array<Vector3d, kBoneCount>& joints);

}  // namespace vitruvia
