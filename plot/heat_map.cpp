#include <algorithm>
#include <cmath>

#include "plot/colours.h"
#include "plot/frame.h"

namespace prehensile::plot {
namespace {

constexpr double kBarGap = 16.0;
constexpr double kBarWidth = 14.0;
constexpr double kTickFont = 11.0;

/// Borders of the cells around these centres, one more than there are centres.
std::vector<double> borders(const std::vector<double>& centres, Scale scale) {
  const auto to = [&](double v) { return scale == Scale::kLog ? std::log(v) : v; };
  const auto from = [&](double v) { return scale == Scale::kLog ? std::exp(v) : v; };
  std::vector<double> out;
  const std::size_t n = centres.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    out.push_back(from(0.5 * to(centres[i]) + 0.5 * to(centres[i + 1])));
  }
  if (n == 1) {
    const double half = scale == Scale::kLog ? std::log(2.0)
                        : centres[0] == 0.0  ? 1.0
                                             : 0.1 * std::abs(centres[0]);
    return {from(to(centres[0]) - half), from(to(centres[0]) + half)};
  }
  out.insert(out.begin(), from(2.0 * to(centres[0]) - to(out.front())));
  out.push_back(from(2.0 * to(centres[n - 1]) - to(out.back())));
  return out;
}

bool ascending(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(),
                            [](double a, double b) { return !(a < b); }) == values.end();
}

bool all_drawable(const std::vector<double>& values, Scale scale) {
  return std::all_of(values.begin(), values.end(),
                     [scale](double v) { return drawable(v, scale); });
}

int bar_ticks(const Frame& frame) {
  return std::max(2, static_cast<int>(frame.height / 60.0));
}

}  // namespace

bool is_drawable(const HeatMap& map) {
  return !map.x.empty() && !map.y.empty() &&
         map.values.size() == map.x.size() * map.y.size() && ascending(map.x) &&
         ascending(map.y);
}

void add_extent(const HeatMap& map, Scale scale_x, Scale scale_y, RangeBuilder& x,
                RangeBuilder& y) {
  if (!all_drawable(map.x, scale_x) || !all_drawable(map.y, scale_y)) return;
  for (const double v : borders(map.x, scale_x)) x.add(v);
  for (const double v : borders(map.y, scale_y)) y.add(v);
}

Range colour_range(const HeatMap& map) {
  RangeBuilder builder(map.scale);
  for (const double v : map.values) builder.add(v);
  return builder.range({}, 0.0);
}

bool has_blank(const HeatMap& map) { return !all_drawable(map.values, map.scale); }

void draw(Drawing& drawing, const Frame& frame, const HeatMap& map, const Range& colours,
          const std::string& hatch) {
  if (!all_drawable(map.x, frame.x.scale) || !all_drawable(map.y, frame.y.scale)) return;
  const std::vector<double> xs = borders(map.x, frame.x.scale);
  const std::vector<double> ys = borders(map.y, frame.y.scale);
  drawing.raw("<g shape-rendering=\"crispEdges\">\n");
  for (std::size_t j = 0; j < map.y.size(); ++j) {
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      const double value = map.values[j * map.x.size() + i];
      const bool shown = drawable(value, map.scale);
      const std::string fill =
          shown ? map_colour(colours.share(value)) : "url(#" + hatch + ')';
      const double left = frame.px_x(xs[i]);
      const double top = frame.px_y(ys[j + 1]);
      // A hair wider than the cell: no seams between neighbours.
      drawing.rectangle(left, top, frame.px_x(xs[i + 1]) - left + (shown ? 0.4 : 0.0),
                        frame.px_y(ys[j]) - top + (shown ? 0.4 : 0.0), fill, {});
    }
  }
  drawing.raw("</g>\n");
}

double colour_bar_width(const Frame& frame, const HeatMap& map, const Range& colours) {
  double widest = 0.0;
  for (const Tick& tick : ticks_of(colours, bar_ticks(frame)).ticks) {
    widest = std::max(widest, text_width(tick.label, kTickFont));
  }
  return kBarGap + kBarWidth + 8.0 + widest + (map.label.empty() ? 4.0 : 22.0);
}

void draw_colour_bar(Drawing& drawing, const Frame& frame, const HeatMap& map,
                     const Range& colours) {
  constexpr int kShades = 64;
  const double left = frame.left + frame.width + kBarGap;
  const double step = frame.height / kShades;
  drawing.raw("<g shape-rendering=\"crispEdges\">\n");
  for (int k = 0; k < kShades; ++k) {
    drawing.rectangle(left, frame.top + (kShades - 1 - k) * step, kBarWidth, step + 0.4,
                      map_colour((k + 0.5) / kShades), {});
  }
  drawing.raw("</g>\n");
  const Drawing::Stroke edge{.colour = kEdgeInk, .width = 1.0};
  drawing.rectangle(left, frame.top, kBarWidth, frame.height, "none", edge);
  const Ticks ticks = ticks_of(colours, bar_ticks(frame));
  double widest = 0.0;
  for (const Tick& tick : ticks.ticks) {
    const double y = frame.top + (1.0 - colours.share(tick.value)) * frame.height;
    const double right = left + kBarWidth;
    drawing.line(right, y, right + (tick.label.empty() ? 2.0 : 4.0), y, edge);
    drawing.text(right + 7.0, y + 0.35 * kTickFont, tick.label, {.size = kTickFont});
    widest = std::max(widest, text_width(tick.label, kTickFont));
  }
  if (ticks.exponent != 0) {
    drawing.text(left, frame.top - 5.0, "×" + power_of_ten(ticks.exponent),
                 {.size = kTickFont});
  }
  drawing.text(left + kBarWidth + 8.0 + widest + 15.0, frame.top + 0.5 * frame.height,
               map.label, {.anchor = Drawing::Anchor::kMiddle, .upright = false});
}

}  // namespace prehensile::plot
