// A person's subject from depth frames alone: the registered body (learning/registration) of one
// shape in all frames.
#pragma once

#include <vector>

#include "config/json_settings.h"
#include "learning/registration/registration.h"
#include "metrics/observation_error.h"
#include "records/surface_strips.h"
#include "sequence/sequence.h"

namespace vitruvia {

struct SeenSubjectSettings {
  int frames = 8;
  int first_frames = 0;
  RegistrationSettings registration;

  void Describe(Fields& fields);
};

struct SeenFrame {
  int frame = 0;
  Registration registration;
  TriangleMesh seen;          // the person's measurements, camera frame
  TriangleMesh body;          // the registered body, camera frame
  ObservationError distance;  // of the two
};

struct SeenSubject {
  BodyModel subject;  // on a tracking mesh, in the T-pose
  std::vector<SeenFrame> frames;
};

// The person of a sequence whose frames show nobody else (masks). DataError that names the frame
// and says why if the first frame that is looked at shows no person.
SeenSubject SubjectFromFrames(const SequenceReader& sequence, Registrar& registrar,
                              const SeenSubjectSettings& settings);

// For each frame: what was seen, the body, both from the front and from the side, and the distance
// of what was seen from the body.
std::vector<SurfaceStrip> SeenSubjectStrips(const SeenSubject& seen);
Json SeenSubjectRecord(const SeenSubject& seen, const SeenSubjectSettings& settings);

}  // namespace vitruvia
