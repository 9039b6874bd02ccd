#include "benchmarks/truth_scores.h"

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"

namespace prehensile::benchmarks {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void Errors::add(const PlanarPose& predicted, const PlanarPose& measured) {
  distance_mm.push_back(1e3 * (translation(predicted) - translation(measured)).norm());
  angle_deg.push_back(kDegPerRad * std::abs(wrapped(predicted.theta - measured.theta)));
}

void Scores::add(const std::string& model, const std::string& recording,
                 const std::string& condition, int push, const PlanarPose& predicted,
                 const PlanarPose& measured) {
  if (all_.find(model) == all_.end()) order_.push_back(model);
  Errors& errors = all_[model];
  errors.add(predicted, measured);
  recordings_[recording][model].add(predicted, measured);
  if (!condition.empty()) conditions_[condition][model].add(predicted, measured);
  if (!csv_) return;
  std::fprintf(csv_, "%s,%s,%d,%s,%.6f,%.6f\n", set_.c_str(), field(recording).c_str(),
               push, field(model).c_str(), errors.distance_mm.back(),
               errors.angle_deg.back());
}

std::pair<double, double> Scores::overall(const std::string& model) const {
  const Errors& errors = all_.at(model);
  return {mean(errors.distance_mm), mean(errors.angle_deg)};
}

void Scores::print() const {
  std::printf("\n%s: error of the end pose, mm / deg\n", set_.c_str());
  std::printf("%-34s %6s %15s %15s %15s\n", "model", "pushes", "mean", "median", "p90");
  for (const std::string& model : order_) {
    const Errors& errors = all_.at(model);
    std::printf("%-34s %6zu   %5.2f / %5.2f   %5.2f / %5.2f   %5.2f / %5.2f\n",
                model.c_str(), errors.distance_mm.size(), mean(errors.distance_mm),
                mean(errors.angle_deg), quantile(errors.distance_mm, 0.5),
                quantile(errors.angle_deg, 0.5), quantile(errors.distance_mm, 0.9),
                quantile(errors.angle_deg, 0.9));
  }
  print_groups("mean per recording:", recordings_);
  if (!conditions_.empty()) print_groups("mean per condition:", conditions_);
}

void Scores::print_groups(const char* title, const Groups& groups) const {
  std::printf("%-34s", title);
  for (const std::string& model : order_) std::printf(" %24s", model.c_str());
  std::printf("\n");
  for (const auto& [group, models] : groups) {
    std::printf("%-34s", group.c_str());
    for (const std::string& model : order_) {
      const Errors& errors = models.at(model);
      std::printf("            %5.2f / %5.2f", mean(errors.distance_mm),
                  mean(errors.angle_deg));
    }
    std::printf("\n");
  }
}

}  // namespace prehensile::benchmarks
