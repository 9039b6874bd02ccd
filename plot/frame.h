/// The rectangle in which a chart draws its data. Internal to the plot layer.
#pragma once

#include <string>

#include "plot/chart.h"
#include "plot/svg.h"
#include "plot/ticks.h"

namespace prehensile::plot {

struct Frame {
  Range x, y;
  double left = 0.0;  ///< [px]
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  double px_x(double value) const { return left + x.share(value) * width; }
  double px_y(double value) const { return top + (1.0 - y.share(value)) * height; }
  bool drawable(const Point& point) const {
    return plot::drawable(point.x, x.scale) && plot::drawable(point.y, y.scale);
  }
};

/// Label of a series, empty where it wants no place in the legend.
const std::string& label_of(const Series& series);

/// What tells a series from the others: its own, or chosen for it.
struct Look {
  Colour colour = Colour::kBlue;
  int round = 0;  ///< how many times all colours were used before
};

/// Look of a series; `used` counts the colours that were chosen.
Look look_of(const Series& series, int& used);

/// The series inside the frame.
void draw(Drawing& drawing, const Frame& frame, const Series& series, const Look& look);

/// The series' sample in a legend, in a box of this size around the middle.
void draw_key(Drawing& drawing, double x, double y, double width, double height,
              const Series& series, const Look& look);

/// Corners of everything that the series draws.
void add_extent(const Series& series, RangeBuilder& x, RangeBuilder& y);
void add_extent(const HeatMap& map, Scale scale_x, Scale scale_y, RangeBuilder& x,
                RangeBuilder& y);

/// Sizes agree, axes ascend.
bool is_drawable(const HeatMap& map);

/// Range of the colours.
Range colour_range(const HeatMap& map);
bool has_blank(const HeatMap& map);

/// `hatch` is the id of the pattern of blank cells.
void draw(Drawing& drawing, const Frame& frame, const HeatMap& map, const Range& colours,
          const std::string& hatch);

/// The bar that explains the colours, to the right of the frame.
void draw_colour_bar(Drawing& drawing, const Frame& frame, const HeatMap& map,
                     const Range& colours);

/// Space that the bar needs [px].
double colour_bar_width(const Frame& frame, const HeatMap& map, const Range& colours);

}  // namespace prehensile::plot
