#include "apps/contact_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

constexpr int kMostCurves = 7;

double share_completed(const ContactVariant& variant) {
  const auto count = static_cast<double>(variant.ensemble.members.size());
  return count > 0.0 ? variant.ensemble.completed() / count : 0.0;
}

std::string label_of(const ContactVariant& variant) {
  return variant.pusher + ", " + variant.pad;
}

std::string cell(const char* format, double value) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 64> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

/// Nobody could tell the two apart in a picture.
bool are_alike(const ContactVariant& a, const ContactVariant& b, double reach) {
  return a.ensemble.completed() == b.ensemble.completed() &&
         std::abs(a.spread(reach) - b.spread(reach)) <= 1e-7 + 1e-3 * a.spread(reach);
}

double displacement(const Deviation& motion, double reach) {
  return std::hypot(motion.normal, motion.tangential, reach * motion.angle);
}

}  // namespace

double ContactVariant::half_width(double Deviation::*part, double level) const {
  const std::vector<double> values = ensemble.sorted(&EnsembleMember::motion, part);
  return 0.5 *
         (quantile(values, 0.5 + 0.5 * level) - quantile(values, 0.5 - 0.5 * level));
}

double ContactVariant::spread(double reach) const {
  double sum = 0.0;
  for (const EnsembleMember& member : ensemble.members) {
    if (!member.completed()) continue;
    const double d = displacement(member.motion, reach);
    sum += d * d;
  }
  const int count = ensemble.completed();
  return count > 0 ? std::sqrt(sum / count) : kNan;
}

std::vector<int> ContactReport::ranking() const {
  std::vector<int> order(variants.size());
  std::iota(order.begin(), order.end(), 0);
  double best = 0.0;
  for (const ContactVariant& variant : variants) {
    best = std::max(best, share_completed(variant));
  }
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    const double done_i = share_completed(variants[i]);
    const double done_j = share_completed(variants[j]);
    const bool reliable_i = done_i > 0.0 && done_i >= 0.99 * best;
    const bool reliable_j = done_j > 0.0 && done_j >= 0.99 * best;
    if (reliable_i != reliable_j) return reliable_i;
    if (!reliable_i) return done_i > done_j;
    return variants[i].spread(reach) < variants[j].spread(reach);
  });
  return order;
}

std::string describe(const ContactReport& report) {
  std::string out = report.question + '\n';
  out += "uncertain: " + box_text(report.box) + '\n';
  out += text(
      "half widths of the middle %g %% of the motions of pushes that complete; "
      "spread: rms displacement of a point %.1f mm from the centre\n",
      100.0 * report.level, to_mm(report.reach));
  Table table({"pusher", "pads", "completed %", "spread mm", "normal mm", "tangential mm",
               "angle deg", "nominal force N", ""});
  std::string refusals;
  for (const int i : report.ranking()) {
    const ContactVariant& variant = report.variants[i];
    if (!variant.refusal.empty()) {
      refusals += label_of(variant) + ": " + variant.refusal + '\n';
      continue;
    }
    table.add(
        {variant.pusher, variant.pad, cell("%.1f", 100.0 * share_completed(variant)),
         cell("%.3f", to_mm(variant.spread(report.reach))),
         cell("%.3f", to_mm(variant.half_width(&Deviation::normal, report.level))),
         cell("%.3f", to_mm(variant.half_width(&Deviation::tangential, report.level))),
         cell("%.3f", to_deg(variant.half_width(&Deviation::angle, report.level))),
         cell("%.3f", variant.ensemble.nominal.max_push_force),
         variant.is_scenes_own ? "the scene's own" : ""});
    if (share_completed(variant) < 1.0) {
      refusals += label_of(variant) + ": " + variant.ensemble.tally() + '\n';
    }
  }
  return out + table.str() + refusals;
}

nlohmann::ordered_json to_json(const ContactReport& report) {
  nlohmann::ordered_json out = {{"question", report.question},
                                {"box", to_json(report.box)},
                                {"level", number(report.level)},
                                {"reach", number(report.reach)},
                                {"contacts", nlohmann::ordered_json::array()}};
  for (const int i : report.ranking()) {
    const ContactVariant& variant = report.variants[i];
    const Transition& nominal = variant.ensemble.nominal;
    out["contacts"].push_back(
        {{"pusher", variant.pusher},
         {"pad", variant.pad},
         {"scenes_own", variant.is_scenes_own},
         {"refused", variant.refusal},
         {"torque_radius", number(variant.torque_radius)},
         {"samples", variant.ensemble.members.size()},
         {"completed", variant.ensemble.completed()},
         {"nominal_status", std::string(name(nominal.status))},
         {"nominal_reason", std::string(nominal.reason)},
         {"spread", number(variant.spread(report.reach))},
         {"normal", number(variant.half_width(&Deviation::normal, report.level))},
         {"tangential", number(variant.half_width(&Deviation::tangential, report.level))},
         {"angle", number(variant.half_width(&Deviation::angle, report.level))},
         {"max_push_force", number(nominal.max_push_force)}});
  }
  return out;
}

std::string to_csv(const ContactReport& report) {
  std::string out =
      "pusher,pad,refused,samples,completed,spread_m,normal_m,tangential_m,angle_rad,"
      "max_push_force_N\n";
  for (const int i : report.ranking()) {
    const ContactVariant& variant = report.variants[i];
    out += csv_line({csv_text(variant.pusher), csv_text(variant.pad),
                     csv_text(variant.refusal),
                     std::to_string(variant.ensemble.members.size()),
                     std::to_string(variant.ensemble.completed()),
                     csv_number(variant.spread(report.reach)),
                     csv_number(variant.half_width(&Deviation::normal, report.level)),
                     csv_number(variant.half_width(&Deviation::tangential, report.level)),
                     csv_number(variant.half_width(&Deviation::angle, report.level)),
                     csv_number(variant.ensemble.nominal.max_push_force)});
  }
  return out;
}

std::string to_svg(const ContactReport& report) {
  plot::Chart ends{.title = "Ends of the motion", .subtitle = report.question};
  ends.x.label = "along the normal, against nominal [mm]";
  ends.y.label = "along the face, against nominal [mm]";
  plot::Chart funnel{.title = "How well each contact funnels the motion",
                     .subtitle = "uncertain: " + box_text(report.box)};
  funnel.x.label =
      text("displacement of a point %.0f mm from the centre [mm]", to_mm(report.reach));
  funnel.y.label = "share of all pushes";
  funnel.y.from_zero = true;
  std::vector<const ContactVariant*> drawn;
  for (const int i : report.ranking()) {
    const ContactVariant& variant = report.variants[i];
    const auto alike = [&](const ContactVariant* other) {
      return are_alike(variant, *other, report.reach);
    };
    if (!variant.refusal.empty() || variant.ensemble.completed() == 0 ||
        static_cast<int>(drawn.size()) == kMostCurves ||
        std::any_of(drawn.begin(), drawn.end(), alike)) {
      continue;
    }
    drawn.push_back(&variant);
    const auto same = std::count_if(
        report.variants.begin(), report.variants.end(), [&](const ContactVariant& other) {
          return &other != &variant && are_alike(variant, other, report.reach);
        });
    std::string label = label_of(variant);
    if (same > 0) label += text(" and %d alike", static_cast<int>(same));
    plot::Steps steps{.label = label};
    plot::Scatter places{.label = label, .size = 2.0};
    std::vector<double> far;
    for (const EnsembleMember& member : variant.ensemble.members) {
      if (!member.completed()) continue;
      far.push_back(displacement(member.motion, report.reach));
      places.points.push_back(
          {to_mm(member.motion.normal), to_mm(member.motion.tangential)});
    }
    std::sort(far.begin(), far.end());
    steps.points.push_back({0.0, 0.0});
    for (std::size_t k = 0; k < far.size(); ++k) {
      steps.points.push_back(
          {to_mm(far[k]), (static_cast<double>(k) + 1.0) /
                              static_cast<double>(variant.ensemble.members.size())});
    }
    funnel.series.emplace_back(std::move(steps));
    // Worst first, so that the best ones are seen on top.
    ends.series.insert(ends.series.begin(), std::move(places));
  }
  // The same colours in both panels.
  for (std::size_t k = 0; k < funnel.series.size(); ++k) {
    static constexpr std::array<plot::Colour, kMostCurves> kColours = {
        plot::Colour::kBlue,   plot::Colour::kRed, plot::Colour::kGreen,
        plot::Colour::kPurple, plot::Colour::kSky, plot::Colour::kOrange,
        plot::Colour::kYellow};
    std::get<plot::Steps>(funnel.series[k]).colour = kColours[k];
    std::get<plot::Scatter>(ends.series[funnel.series.size() - 1 - k]).colour =
        kColours[k];
  }
  return plot::svg_of_sheet({funnel, ends}, 2);
}

}  // namespace prehensile::apps
