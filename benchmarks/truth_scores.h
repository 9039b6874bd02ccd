/// Errors of predicted end poses, model by model: overall, per recording and per further
/// condition; and as CSV lines.
#pragma once

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "scene/frames.h"

namespace prehensile::benchmarks {

inline constexpr double kDegPerRad = 57.29577951308232;

double mean(const std::vector<double>& values);

/// Errors of one model over many pushes.
struct Errors {
  std::vector<double> distance_mm, angle_deg;

  void add(const PlanarPose& predicted, const PlanarPose& measured);
};

/// All results of a set.
class Scores {
 public:
  Scores(std::string set, std::FILE* csv) : set_(std::move(set)), csv_(csv) {}

  /// `condition`: another grouping beside the recording; empty: none.
  void add(const std::string& model, const std::string& recording,
           const std::string& condition, int push, const PlanarPose& predicted,
           const PlanarPose& measured);

  void print() const;

  /// Mean of one model overall: distance [mm], angle [deg].
  std::pair<double, double> overall(const std::string& model) const;

 private:
  using Groups = std::map<std::string, std::map<std::string, Errors>>;

  void print_groups(const char* title, const Groups& groups) const;

  std::string set_;
  std::FILE* csv_;
  std::vector<std::string> order_;
  std::map<std::string, Errors> all_;
  Groups recordings_, conditions_;  // group, then model
};

}  // namespace prehensile::benchmarks
