// The checks that a verification consists of. For this module's own files.
#pragma once

#include <vector>

#include "sequence/sequence.h"
#include "verification/finding.h"

namespace vitruvia {

// `count` of them evenly spread, the first and the last among them; all if there are fewer.
std::vector<int> SpreadFrames(int frames, int count);

Findings CheckCamera(const PinholeCamera& camera);
Findings CheckSubject(const BodyModel& subject);  // files named without their folder

// truth/joints.json: bone lengths against the subject's and over time, motion, first frame.
Findings CheckTrueJoints(const SequenceReader& sequence);

// truth/vertices.bin against truth/mesh.ply, and truth/joints.json against both.
Findings CheckTrueSurface(const SequenceReader& sequence, const std::vector<int>& frames);

// depth/ by itself: empty, constant, byte order, repeated.
Findings CheckImages(const SequenceReader& sequence, const std::vector<int>& frames);

// depth/ against the true surface, the true joints or the subject's size, whichever is there first.
Findings CheckDepth(const SequenceReader& sequence, const std::vector<int>& frames);

// Each image against the truth of its own frame, where there is a true surface: another moment, and
// joints whose "visible" the image contradicts.
Findings CheckFrames(const SequenceReader& sequence, const std::vector<int>& frames);

}  // namespace vitruvia
