// A tracker that runs as a separate program, in any language; PROTOCOL.md defines the messages. The
// times of its frames include the communication.
#pragma once

#include <memory>

#include "methods/external/settings.h"
#include "tracking/tracker.h"

namespace vitruvia::external {

class External final : public Tracker {
 public:
  explicit External(const Settings& settings);
  ~External() override;

  // Both throw RunError if the program ends, hangs or sends an invalid answer, and ConfigError if
  // it cannot be started.
  void Start(const Subject& subject, const PinholeCamera& camera) override;
  TrackResult TrackFrame(const DepthFrame& frame) override;

 private:
  struct Session;

  Settings settings_;
  std::unique_ptr<Session> session_;
};

}  // namespace vitruvia::external
