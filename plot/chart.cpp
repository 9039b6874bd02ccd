/// The layout of a chart: title, legend, axes, and the frame for the data.
#include "plot/chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plot/colours.h"
#include "plot/frame.h"

namespace prehensile::plot {
namespace {

constexpr double kTitleFont = 15.0;
constexpr double kFont = 12.0;
constexpr double kTickFont = 11.0;
constexpr double kMargin = 14.0;
constexpr double kKeyWidth = 24.0;
constexpr double kLegendRow = 18.0;
constexpr double kPadding = 0.04;

const Drawing::Stroke kEdge{.colour = kEdgeInk, .width = 1.0};
const Drawing::Stroke kGrid{.colour = kGridInk, .width = 1.0};

double clamped(double size, double low, double high, double otherwise) {
  return std::isfinite(size) ? std::clamp(size, low, high) : otherwise;
}

/// `room`: for so many labels.
Ticks ticks_along(const AxisOptions& axis, const Range& range, double room) {
  if (!axis.names.empty()) return ticks_of(range, axis.names);
  return ticks_of(range, std::max(2, static_cast<int>(room)));
}

/// One chart on a sheet: `index` makes its ids unique.
class Layout {
 public:
  Layout(const Chart& chart, int index)
      : chart_(chart),
        index_(index),
        width_(clamped(chart.width, 200.0, 4000.0, 640.0)),
        height_(clamped(chart.height, 150.0, 4000.0, 440.0)),
        has_map_(chart.map && is_drawable(*chart.map)) {
    int used = 0;
    for (const Series& series : chart.series) {
      looks_.push_back(look_of(series, used));
    }
    if (has_map_) map_colours_ = colour_range(*chart.map);
    arrange();
  }

  double width() const { return width_; }
  double height() const { return height_; }

  std::string str() {
    drawing_.rectangle(0.0, 0.0, width_, height_, kPaper, {});
    draw_head();
    draw_definitions();
    if (!has_map_) draw_grid();
    drawing_.raw("<g clip-path=\"url(#" + id("clip") + ")\">\n");
    if (has_map_) draw(drawing_, frame_, *chart_.map, map_colours_, id("hatch"));
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      draw(drawing_, frame_, chart_.series[i], looks_[i]);
    }
    drawing_.raw("</g>\n");
    draw_axes();
    if (has_map_) draw_colour_bar(drawing_, frame_, *chart_.map, map_colours_);
    if (is_empty_) {
      drawing_.text(frame_.left + 0.5 * frame_.width, frame_.top + 0.5 * frame_.height,
                    "nothing to draw",
                    {.colour = kFaintInk, .anchor = Drawing::Anchor::kMiddle});
    }
    return drawing_.str();
  }

 private:
  struct Key {
    std::string label;
    const Series* series;  ///< null: the hatching of a map
    Look look;
    double x = 0.0;
    int row = 0;
  };

  std::string id(const char* what) const { return what + std::to_string(index_); }

  void arrange() {
    list_keys();
    RangeBuilder x(chart_.x.scale);
    RangeBuilder y(chart_.y.scale);
    if (has_map_) add_extent(*chart_.map, chart_.x.scale, chart_.y.scale, x, y);
    for (const Series& series : chart_.series) add_extent(series, x, y);
    is_empty_ = x.empty() || y.empty();
    const double padding = has_map_ ? 0.0 : kPadding;
    const Range range_x = x.range(chart_.x, padding);
    const Range range_y = y.range(chart_.y, padding);

    double head = kMargin;
    if (!chart_.title.empty()) head += 20.0;
    if (!chart_.subtitle.empty()) head += 16.0;
    legend_top_ = head;
    head += rows_ * kLegendRow + 16.0;
    frame_.top = head;
    frame_.height =
        std::max(40.0, height_ - head - (chart_.x.label.empty() ? 34.0 : 52.0));
    // Twice: the labels of y decide the width, which may decide the labels of y.
    frame_.left = 64.0;
    for (int pass = 0; pass < 2; ++pass) {
      frame_.x = range_x;
      frame_.y = range_y;
      const double bar =
          has_map_ ? colour_bar_width(frame_, *chart_.map, map_colours_) : 0.0;
      frame_.width = std::max(40.0, width_ - frame_.left - kMargin - 8.0 - bar);
      if (chart_.equal_scales) equalise();
      ticks_y_ = ticks_along(chart_.y, frame_.y, frame_.height / 45.0);
      double widest = 0.0;
      for (const Tick& tick : ticks_y_.ticks) {
        widest = std::max(widest, text_width(tick.label, kTickFont));
      }
      frame_.left = kMargin + (chart_.y.label.empty() ? 0.0 : 18.0) + widest + 8.0;
    }
    ticks_x_ = ticks_along(chart_.x, frame_.x, frame_.width / 80.0);
  }

  /// Widens the range that has fewer units per pixel.
  void equalise() {
    if (frame_.x.scale != Scale::kLinear || frame_.y.scale != Scale::kLinear) return;
    const double unit_x = (frame_.x.high - frame_.x.low) / frame_.width;
    const double unit_y = (frame_.y.high - frame_.y.low) / frame_.height;
    const double unit = std::max(unit_x, unit_y);
    const auto widen = [unit](Range& range, double pixels) {
      const double middle = 0.5 * range.low + 0.5 * range.high;
      range.low = middle - 0.5 * unit * pixels;
      range.high = middle + 0.5 * unit * pixels;
    };
    widen(frame_.x, frame_.width);
    widen(frame_.y, frame_.height);
  }

  /// Places of the legend's keys, in rows.
  void list_keys() {
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const std::string& label = label_of(chart_.series[i]);
      if (!label.empty()) keys_.push_back({label, &chart_.series[i], looks_[i]});
    }
    if (has_map_ && !chart_.map->blank.empty() && has_blank(*chart_.map)) {
      keys_.push_back({chart_.map->blank, nullptr, {Colour::kGrey}});
    }
    double x = kMargin;
    int row = 0;
    for (Key& key : keys_) {
      const double needed = kKeyWidth + 6.0 + text_width(key.label, kFont) + 18.0;
      if (x > kMargin && x + needed > width_ - kMargin) {
        x = kMargin;
        ++row;
      }
      key.x = x;
      key.row = row;
      x += needed;
    }
    rows_ = keys_.empty() ? 0 : row + 1;
  }

  void draw_head() {
    double y = kMargin;
    if (!chart_.title.empty()) {
      drawing_.text(kMargin, y + 12.0, chart_.title, {.size = kTitleFont, .bold = true});
      y += 20.0;
    }
    if (!chart_.subtitle.empty()) {
      drawing_.text(kMargin, y + 10.0, chart_.subtitle,
                    {.size = 11.0, .colour = kSoftInk});
    }
    for (const Key& key : keys_) {
      const double middle = legend_top_ + (key.row + 0.5) * kLegendRow;
      if (key.series) {
        draw_key(drawing_, key.x, middle, kKeyWidth, 10.0, *key.series, key.look);
      } else {
        drawing_.rectangle(key.x, middle - 5.0, kKeyWidth, 10.0,
                           "url(#" + id("hatch") + ')', kGrid);
      }
      drawing_.text(key.x + kKeyWidth + 6.0, middle + 0.35 * kFont, key.label,
                    {.size = kFont});
    }
  }

  void draw_definitions() {
    drawing_.raw("<clipPath id=\"" + id("clip") + "\">\n");
    drawing_.rectangle(frame_.left, frame_.top, frame_.width, frame_.height, kPaper, {});
    drawing_.raw("</clipPath>\n");
    if (!has_map_) return;
    drawing_.raw("<pattern id=\"" + id("hatch") +
                 "\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">\n"
                 "<rect x=\"0\" y=\"0\" width=\"6\" height=\"6\" fill=\"" +
                 std::string(kHatchPaper) + "\"/>\n<path d=\"M0 6 L6 0\" stroke=\"" +
                 kHatchInk +
                 "\" stroke-width=\"1\" "
                 "fill=\"none\"/>\n</pattern>\n");
  }

  void draw_grid() {
    for (const Tick& tick : ticks_x_.ticks) {
      if (tick.label.empty()) continue;
      const double x = frame_.px_x(tick.value);
      drawing_.line(x, frame_.top, x, frame_.top + frame_.height, kGrid);
    }
    for (const Tick& tick : ticks_y_.ticks) {
      if (tick.label.empty()) continue;
      const double y = frame_.px_y(tick.value);
      drawing_.line(frame_.left, y, frame_.left + frame_.width, y, kGrid);
    }
  }

  void draw_axes() {
    drawing_.rectangle(frame_.left, frame_.top, frame_.width, frame_.height, "none",
                       kEdge);
    const double bottom = frame_.top + frame_.height;
    for (const Tick& tick : ticks_x_.ticks) {
      const double x = frame_.px_x(tick.value);
      drawing_.line(x, bottom, x, bottom + (tick.label.empty() ? 2.5 : 5.0), kEdge);
      if (tick.label.empty()) continue;
      drawing_.text(x, bottom + 18.0, tick.label,
                    {.size = kTickFont, .anchor = Drawing::Anchor::kMiddle});
    }
    for (const Tick& tick : ticks_y_.ticks) {
      const double y = frame_.px_y(tick.value);
      drawing_.line(frame_.left - (tick.label.empty() ? 2.5 : 5.0), y, frame_.left, y,
                    kEdge);
      if (tick.label.empty()) continue;
      drawing_.text(frame_.left - 8.0, y + 0.35 * kTickFont, tick.label,
                    {.size = kTickFont, .anchor = Drawing::Anchor::kEnd});
    }
    draw_axis_labels(bottom);
  }

  void draw_axis_labels(double bottom) {
    if (ticks_x_.exponent != 0) {
      drawing_.text(frame_.left + frame_.width, bottom + 34.0,
                    "×" + power_of_ten(ticks_x_.exponent),
                    {.size = kTickFont, .anchor = Drawing::Anchor::kEnd});
    }
    if (ticks_y_.exponent != 0) {
      drawing_.text(frame_.left, frame_.top - 5.0, "×" + power_of_ten(ticks_y_.exponent),
                    {.size = kTickFont});
    }
    if (!chart_.x.label.empty()) {
      drawing_.text(frame_.left + 0.5 * frame_.width, bottom + 38.0, chart_.x.label,
                    {.anchor = Drawing::Anchor::kMiddle});
    }
    if (!chart_.y.label.empty()) {
      drawing_.text(kMargin + 8.0, frame_.top + 0.5 * frame_.height, chart_.y.label,
                    {.anchor = Drawing::Anchor::kMiddle, .upright = false});
    }
  }

  const Chart& chart_;
  int index_;
  double width_;
  double height_;
  bool has_map_;
  bool is_empty_ = false;
  std::vector<Look> looks_;
  Range map_colours_;
  std::vector<Key> keys_;
  int rows_ = 0;
  double legend_top_ = 0.0;
  Frame frame_;
  Ticks ticks_x_, ticks_y_;
  Drawing drawing_;
};

std::string document(double width, double height, const std::string& body) {
  const std::string w = fixed(width, 0);
  const std::string h = fixed(height, 0);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
         w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + ' ' + h +
         "\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n" + body +
         "</svg>\n";
}

}  // namespace

std::string Chart::svg() const {
  Layout layout(*this, 0);
  return document(layout.width(), layout.height(), layout.str());
}

std::string svg_of_sheet(const std::vector<Chart>& charts, int columns) {
  columns = std::max(1, columns);
  double width = 0.0;
  double x = 0.0;
  double y = 0.0;
  double row_height = 0.0;
  std::string body;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (i > 0 && i % static_cast<std::size_t>(columns) == 0) {
      y += row_height;
      x = row_height = 0.0;
    }
    Layout layout(charts[i], static_cast<int>(i));
    body += "<g transform=\"translate(" + px(x) + ' ' + px(y) + ")\">\n" + layout.str() +
            "</g>\n";
    x += layout.width();
    width = std::max(width, x);
    row_height = std::max(row_height, layout.height());
  }
  return document(std::max(1.0, width), std::max(1.0, y + row_height), body);
}

std::vector<Point> sector(const Point& centre, double inner, double outer, double from,
                          double to) {
  const double span = std::min(std::abs(to - from), 2.0 * std::numbers::pi);
  const double end = to >= from ? from + span : from - span;
  const int pieces = std::max(2, static_cast<int>(std::ceil(span / 0.035)));
  std::vector<Point> out;
  const auto arc = [&](double radius, double a, double b) {
    for (int k = 0; k <= pieces; ++k) {
      const double angle = a + (b - a) * k / pieces;
      out.push_back(
          {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
  };
  arc(outer, from, end);
  if (inner > 0.0) {
    arc(inner, end, from);
  } else {
    out.push_back(centre);
  }
  return out;
}

}  // namespace prehensile::plot
