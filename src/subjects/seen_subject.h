// Estimates a person's subject from depth frames alone: the registered body
// (learning/registration), with the same shape in all frames.
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
  ObservationError distance;  // of `body` from the measurements
};

struct SeenSubject {
  BodyModel subject;  // on a tracking mesh, in the T-pose
  std::vector<SeenFrame> frames;
};

// Estimates the person of a sequence whose frames show nobody else (masks). DataError naming the
// frame and the reason if the first frame used shows no person.
SeenSubject SubjectFromFrames(const SequenceReader& sequence, Registrar& registrar,
                              const SeenSubjectSettings& settings);

// For each frame: the measurements, the body, both from the front and from the side, and the
// distance of the measurements from the body.
std::vector<SurfaceStrip> SeenSubjectStrips(const SeenSubject& seen);
Json SeenSubjectRecord(const SeenSubject& seen, const SeenSubjectSettings& settings);

}  // namespace vitruvia
