// The checks of a verification. Internal to this module.
#pragma once

#include <vector>

#include "sequence/sequence.h"
#include "verification/finding.h"

namespace vitruvia {

Findings CheckCamera(const PinholeCamera& camera);
Findings CheckSubject(const BodyModel& subject);  // files named without their folder

// truth/joints.json: bone lengths against the subject's and over time, motion, first frame.
Findings CheckTrueJoints(const SequenceReader& sequence);

// truth/vertices.bin against truth/mesh.ply, and truth/joints.json against both.
Findings CheckTrueSurface(const SequenceReader& sequence, const std::vector<int>& frames);

// depth/ alone: empty or constant images, byte order, repeated images.
Findings CheckImages(const SequenceReader& sequence, const std::vector<int>& frames, int threads);

// depth/ against the first of these that is available: the true surface, the true joints, the
// subject's size.
Findings CheckDepth(const SequenceReader& sequence, const std::vector<int>& frames);

// Each image against the true surface of its frame, if there is one: finds images of another
// moment, and joints whose flag "visible" the image contradicts.
Findings CheckFrames(const SequenceReader& sequence, const std::vector<int>& frames);

}  // namespace vitruvia
