// The timed steps of paper A's algorithm 1. The tracker uses these identifiers to time them, and
// the tables to compare them with paper A's table 1, so that each name is defined only here.
#pragma once

namespace vitruvia {

enum class RealtimeScapeStep {
  kCloudTree,
  kRender,
  kModelTree,
  kClassify,
  kCorrespond,
  kAssemble,
  kSolve,
  kUpdate,
  kRelocalize,  // not in the paper
  kCount
};

// Name with the line's number in algorithm 1.
constexpr const char* Name(RealtimeScapeStep step) {
  switch (step) {
    case RealtimeScapeStep::kCloudTree:
      return "2 kd-tree of P";
    case RealtimeScapeStep::kRender:
      return "5 render";
    case RealtimeScapeStep::kModelTree:
      return "6 kd-tree of V";
    case RealtimeScapeStep::kClassify:
      return "7 classify";
    case RealtimeScapeStep::kCorrespond:
      return "8 correspond";
    case RealtimeScapeStep::kAssemble:
      return "9 assemble";
    case RealtimeScapeStep::kSolve:
      return "10 solve";
    case RealtimeScapeStep::kUpdate:
      return "11 update";
    case RealtimeScapeStep::kRelocalize:
      return "recover";
    case RealtimeScapeStep::kCount:
      break;
  }
  return "";
}

}  // namespace vitruvia
