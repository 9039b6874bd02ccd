/// Answers about one spatial instant as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/instant_report.h"
#include "mechanics/spatial_certificate.h"

namespace prehensile::apps {

struct SpatialReport {
  std::string question;         ///< one line for people
  std::string why_this_solver;  ///< empty: the user chose it
  bool probed = false;          ///< other motions were searched for
  SpatialProblem problem;
  SpatialInstant instant;
  SpatialCertificate certificate;
  Sensitivities sensitivities;
};

std::string describe(const SpatialReport& report);
nlohmann::ordered_json to_json(const SpatialReport& report);

}  // namespace prehensile::apps
