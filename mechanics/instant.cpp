#include "mechanics/instant.h"

namespace prehensile {

std::string_view name(InstantStatus status) {
  switch (status) {
    case InstantStatus::kNotRun:
      return "not run";
    case InstantStatus::kMoves:
      return "moves";
    case InstantStatus::kHolds:
      return "holds";
    case InstantStatus::kNonuniqueForces:
      return "non-unique forces";
    case InstantStatus::kAmbiguous:
      return "ambiguous";
    case InstantStatus::kSeparated:
      return "separated";
    case InstantStatus::kDynamic:
      return "dynamic";
    case InstantStatus::kJammed:
      return "jammed";
    case InstantStatus::kOutOfIterations:
      return "out of iterations";
    case InstantStatus::kBadInput:
      return "bad input";
  }
  return "unknown";
}

bool usable(InstantStatus status) {
  return status == InstantStatus::kMoves || status == InstantStatus::kHolds ||
         status == InstantStatus::kNonuniqueForces || status == InstantStatus::kSeparated;
}

bool has_motion(InstantStatus status) {
  return usable(status) || status == InstantStatus::kAmbiguous;
}

std::string_view name(ContactMode mode) {
  switch (mode) {
    case ContactMode::kOpen:
      return "open";
    case ContactMode::kStick:
      return "stick";
    case ContactMode::kSlipPlus:
      return "slip plus";
    case ContactMode::kSlipMinus:
      return "slip minus";
    case ContactMode::kSlip:
      return "slip";
  }
  return "unknown";
}

}  // namespace prehensile
