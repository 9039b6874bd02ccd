/// Answers about one instant as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mechanics/certificate.h"
#include "mechanics/cross_section.h"
#include "mechanics/instant.h"
#include "mechanics/sensitivity.h"
#include "mechanics/spatial_problem.h"

namespace prehensile::apps {

/// How the answer changes, by InstantParameter; empty where that was not asked for.
struct Sensitivities {
  struct Row {
    double push_force = kNan;
    SpatialTwist V_HO = SpatialTwist::Constant(kNan);
    SpatialWrench w_push = SpatialWrench::Constant(kNan);
  };
  std::vector<Row> rows;
  double mode_slack = kNan;  ///< see DifferentiatedInstant
};
std::string describe(const Sensitivities& sensitivities);
nlohmann::ordered_json to_json(const Sensitivities& sensitivities);

/// What was asked, how it was solved, and what came out. `certificate_worst` is the
/// largest entry, by the certificate or by the residual of the model that was asked.
struct InstantReport {
  std::string question;  ///< one line for people
  std::string solver;
  std::string why_this_solver;  ///< empty: the user chose it
  PlanarGrasp grasp;
  PlanarDrive drive;
  PlanarInstant instant;
  Certificate certificate;  ///< entries are NaN for the closed form, which has no points
  double certificate_worst = kNan;

  Sensitivities sensitivities;
};

std::string describe(const InstantReport& report);
nlohmann::ordered_json to_json(const InstantReport& report);

struct RollReport {
  std::string question;
  CrossSectionInstant instant;
  double residual = kNan;
  double threshold = kNan;  ///< least friction of the support for rolling (closed form)
};

std::string describe(const RollReport& report);
nlohmann::ordered_json to_json(const RollReport& report);

/// What a status means, in a sentence.
const char* meaning(InstantStatus status);

}  // namespace prehensile::apps
