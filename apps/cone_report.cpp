#include "apps/cone_report.h"

#include <algorithm>
#include <cmath>

#include "apps/csv.h"
#include "apps/json_number.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

/// Rows of the table, about: every fifth slice of as many as there are by default.
constexpr std::size_t kRows = 36;

std::string ranges_text(const std::vector<DirectionRange>& ranges) {
  std::string out;
  for (const DirectionRange& range : ranges) {
    out += out.empty() ? "" : " and ";
    out += text("%.2f to %.2f deg", to_deg(range.lo), to_deg(range.hi));
  }
  return out.empty() ? "none" : out;
}

/// Rates of turn in degrees per millimetre.
std::string rates_text(const KappaSet& set) {
  std::string out;
  for (int i = 0; i < set.count; ++i) {
    out += out.empty() ? "" : ", ";
    out += text("%.3f to %.3f", 1e-3 * to_deg(set.intervals[i].lo),
                1e-3 * to_deg(set.intervals[i].hi));
  }
  return out.empty() ? "-" : out;
}

std::string check_text(const ConeCheck& check, bool in_space) {
  if (check.asked == 0) return "";
  std::string out =
      text("checked by %d instants of random motions (%d inside the nominal cone): ",
           check.asked, check.inside);
  if (in_space) {
    out += text("the spatial solver with the real pads agrees in %d of %d\n",
                check.exact_agrees, check.exact_asked);
  } else {
    out += text("the limit surface agrees in %d of %d", check.closed_agrees,
                check.asked - check.not_unique);
    if (check.not_unique > 0) {
      out += text(" (%d have no unique motion)", check.not_unique);
    }
    out += text(", the exact solver with the real pads in %d of %d\n", check.exact_agrees,
                check.exact_asked);
  }
  if (check.robust_asked > 0) {
    out += text(
        "of %d motions inside the robust cone, each with a member of the box drawn anew, "
        "%d stuck\n",
        check.robust_asked, check.robust_sticks);
  }
  return out;
}

nlohmann::ordered_json to_json(const std::vector<DirectionRange>& ranges) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const DirectionRange& range : ranges) {
    out.push_back({number(range.lo), number(range.hi)});
  }
  return out;
}

nlohmann::ordered_json to_json(const KappaSet& set) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (int i = 0; i < set.count; ++i) {
    out.push_back({number(set.intervals[i].lo), number(set.intervals[i].hi)});
  }
  return out;
}

/// How a motion shares between moving and turning: atan(c omega / speed) in degrees.
double turn_angle(double rate, double c) { return to_deg(std::atan(c * rate)); }

/// One band per interval, broken where a direction has fewer.
void add_bands(const MotionCone& cone, KappaSet ConeSlice::*set, const char* label,
               plot::Colour colour, plot::Chart& chart) {
  for (int k = 0; k < 4; ++k) {
    plot::Band band{.label = k == 0 ? label : "", .colour = colour};
    bool any = false;
    for (const ConeSlice& slice : cone.slices) {
      const KappaSet& kappas = slice.*set;
      const bool has = k < kappas.count;
      any = any || has;
      band.rows.push_back({to_deg(slice.direction),
                           has ? turn_angle(kappas.intervals[k].lo, cone.c) : kNan,
                           has ? turn_angle(kappas.intervals[k].hi, cone.c) : kNan});
    }
    if (any || k == 0) chart.series.emplace_back(std::move(band));
  }
}

plot::Chart chart_of_motions(const ConeReport& report) {
  plot::Chart chart{.title = "Motions that stick", .subtitle = report.question};
  chart.x.label = "direction from the normal [deg]";
  chart.y.label = "turning, atan(c ω / v) [deg]";
  add_bands(report.cone, &ConeSlice::nominal, "nominal", plot::Colour::kBlue, chart);
  add_bands(report.cone, &ConeSlice::robust, "robust", plot::Colour::kRed, chart);
  return chart;
}

plot::Point mm(const Vec2& p) { return {to_mm(p.x()), to_mm(p.y())}; }

/// Object, finger axis, pusher and the directions that stick, seen from the hand.
plot::Chart chart_of_directions(const ConeReport& report) {
  const PlanarPose& X_HO = report.grasp.X_HO;
  const PushContact& contact = report.model.contacts[report.contact];
  const PushContact::Segment segment = contact.segment(report.place);
  plot::Chart chart{.title = report.cone.is_point ? "Directions in which the point sticks"
                                                  : "Straight pushes that stick",
                    .subtitle = text("nominal ") + ranges_text(report.cone.nominal) +
                                "; robust " + ranges_text(report.cone.robust)};
  chart.x.label = "x in the hand [mm]";
  chart.y.label = "y in the hand [mm]";
  chart.equal_scales = true;
  plot::Region object{.label = "object", .colour = plot::Colour::kGrey, .filled = false};
  for (const Vec2& p : report.model.outline) {
    object.points.push_back(mm(transform(X_HO, p)));
  }
  chart.series.emplace_back(object);
  const Vec2 centre = transform(X_HO, 0.5 * (segment.a + segment.b));
  const Vec2 n = rotated(X_HO.theta, contact.n);
  const double normal = std::atan2(n.y(), n.x());
  const double reach = to_mm(0.4 * report.model.L);
  const auto add_sectors = [&](const std::vector<DirectionRange>& ranges,
                               const char* label, plot::Colour colour) {
    for (const DirectionRange& range : ranges) {
      chart.series.emplace_back(plot::Region{
          .label = &range == ranges.data() ? label : "",
          .points =
              plot::sector(mm(centre), 0.0, reach, normal + range.lo, normal + range.hi),
          .colour = colour});
    }
  };
  add_sectors(report.cone.nominal, "nominal", plot::Colour::kBlue);
  add_sectors(report.cone.robust, "robust", plot::Colour::kRed);
  chart.series.emplace_back(plot::Line{
      .label = "pusher",
      .points = {mm(transform(X_HO, segment.a)), mm(transform(X_HO, segment.b))},
      .colour = plot::Colour::kBlack,
      .marks = true});
  chart.series.emplace_back(plot::Scatter{.label = "finger axis",
                                          .points = {{0.0, 0.0}},
                                          .colour = plot::Colour::kGreen,
                                          .mark = plot::Mark::kDiamond,
                                          .size = 5.0});
  return chart;
}

}  // namespace

bool is_empty(const MotionCone& cone) {
  return cone.nominal.empty() &&
         std::all_of(cone.slices.begin(), cone.slices.end(),
                     [](const ConeSlice& slice) { return slice.nominal.empty(); });
}

std::string describe(const ConeReport& report) {
  const MotionCone& cone = report.cone;
  std::string out = report.question + '\n';
  if (report.in_space) out += "by spatial instants: the scene needs space\n";
  out += "robust against " + box_text(report.box) +
         text(": the intersection over %d members (corners of the box and points inside)",
              cone.members) +
         '\n';
  if (report.unusable > 0) {
    out +=
        text("%d members of the box are no grasp and were left out\n", report.unusable);
  }
  out += cone.is_point ? "directions of the point's velocity, from the normal:\n"
                       : "straight pushes, directions from the normal:\n";
  out += "  nominal  " + ranges_text(cone.nominal) + "\n  robust   " +
         ranges_text(cone.robust) + '\n';
  if (!cone.is_point) {
    Table table({"direction deg", "turning deg/mm", "robust deg/mm"});
    const std::size_t stride = std::max<std::size_t>(1, cone.slices.size() / kRows);
    for (std::size_t i = 0; i < cone.slices.size(); i += stride) {
      const ConeSlice& slice = cone.slices[i];
      if (slice.nominal.empty()) continue;
      table.add({text("%.0f", to_deg(slice.direction)), rates_text(slice.nominal),
                 rates_text(slice.robust)});
    }
    out += table.str();
  }
  if (is_empty(cone)) out += "no motion of this pusher sticks here\n";
  return out + check_text(report.check, report.in_space);
}

nlohmann::ordered_json to_json(const ConeReport& report) {
  const MotionCone& cone = report.cone;
  nlohmann::ordered_json out = {
      {"question", report.question},
      {"pusher", cone.is_point ? "point" : "line"},
      {"in_space", report.in_space},
      {"torque_radius", number(cone.c)},
      {"box", to_json(report.box)},
      {"members", cone.members},
      {"members_left_out", report.unusable},
      {"directions",
       {{"nominal", to_json(cone.nominal)}, {"robust", to_json(cone.robust)}}},
      {"slices", nlohmann::ordered_json::array()}};
  for (const ConeSlice& slice : cone.slices) {
    if (slice.nominal.empty()) continue;
    out["slices"].push_back({{"direction", number(slice.direction)},
                             {"nominal", to_json(slice.nominal)},
                             {"robust", to_json(slice.robust)}});
  }
  const ConeCheck& check = report.check;
  nlohmann::ordered_json& judged = out["check"];
  judged = {{"instants", check.asked}, {"inside", check.inside}};
  if (!report.in_space) {
    judged["not_unique"] = check.not_unique;
    judged["limit_surface_agrees"] = check.closed_agrees;
  }
  judged["exact_asked"] = check.exact_asked;
  judged["exact_agrees"] = check.exact_agrees;
  judged["robust_asked"] = check.robust_asked;
  judged["robust_sticks"] = check.robust_sticks;
  return out;
}

std::string to_csv(const ConeReport& report) {
  std::string out = "cone,direction_rad,lo_rad_per_m,hi_rad_per_m\n";
  const auto add = [&](const char* kind, double direction, double lo, double hi) {
    out += csv_line({kind, csv_number(direction), csv_number(lo), csv_number(hi)});
  };
  for (const DirectionRange& range : report.cone.nominal) {
    for (const double edge : {range.lo, range.hi}) add("nominal edge", edge, 0.0, 0.0);
  }
  for (const DirectionRange& range : report.cone.robust) {
    for (const double edge : {range.lo, range.hi}) add("robust edge", edge, 0.0, 0.0);
  }
  for (const ConeSlice& slice : report.cone.slices) {
    for (int i = 0; i < slice.nominal.count; ++i) {
      const KappaSet::Interval& interval = slice.nominal.intervals[i];
      add("nominal", slice.direction, interval.lo, interval.hi);
    }
    for (int i = 0; i < slice.robust.count; ++i) {
      const KappaSet::Interval& interval = slice.robust.intervals[i];
      add("robust", slice.direction, interval.lo, interval.hi);
    }
  }
  return out;
}

std::string to_svg(const ConeReport& report) {
  std::vector<plot::Chart> charts = {chart_of_directions(report)};
  if (!report.cone.is_point) charts.push_back(chart_of_motions(report));
  return plot::svg_of_sheet(charts, 2);
}

}  // namespace prehensile::apps
