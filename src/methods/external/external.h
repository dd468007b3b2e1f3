// A tracker that is a program of its own, in any language: PROTOCOL.md says what the two say to
// each other. Times of its frames include the way there and back.
#pragma once

#include <memory>

#include "methods/external/settings.h"
#include "tracking/tracker.h"

namespace vitruvia::external {

class External final : public Tracker {
 public:
  explicit External(const Settings& settings);
  ~External() override;

  // Both throw RunError if the program ends, hangs or answers what it must not, ConfigError if it
  // cannot be started.
  void Start(const Subject& subject, const PinholeCamera& camera) override;
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  struct Session;

  Settings settings_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::external
