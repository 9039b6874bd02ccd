/// Charts as SVG text: lines, steps, points, bands, filled regions and heat maps over
/// linear or logarithmic axes, light background, legible in print.
///
/// Values that cannot be drawn (not finite, beyond 1e300, or not positive on a
/// logarithmic axis) are left out: lines break there, cells of a heat map are hatched. A
/// chart without anything to draw says so. The same chart gives the same text on every
/// machine. The library knows files and physics of nobody: write the text with
/// `write_atomically` of io/plan_file.h.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace prehensile::plot {

/// In data units.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

enum class Scale { kLinear, kLog };

/// Unset ends follow the data. Ends that cannot be drawn or are equal are ignored, ends
/// in the wrong order exchanged.
struct AxisOptions {
  std::string label;  ///< with its unit: "grip force [N]"
  Scale scale = Scale::kLinear;
  std::optional<double> low, high;
  bool from_zero = false;  ///< the range includes zero (linear axes only)
  std::vector<std::string>
      names;  ///< of the values 0, 1, 2, ...: stand instead of numbers
};

/// One of eight colours that colour-blind readers can tell apart; kNext: the next one
/// that the chart has not used, and where all were used, the first again with other marks
/// and dashes; kSame: what kNext gave last, for series that belong together.
enum class Colour {
  kNext,
  kSame,
  kBlue,
  kOrange,
  kGreen,
  kPurple,
  kSky,
  kRed,
  kYellow,
  kBlack,
  kGrey
};

enum class Dash { kSolid, kDashed, kDotted };

/// A polyline through the points in the order given; `marks` also shows the points.
struct Line {
  std::string label;  ///< in the legend; empty: not there
  std::vector<Point> points;
  Colour colour = Colour::kNext;
  Dash dash = Dash::kSolid;
  bool marks = false;
};

/// Constant from each point to the next: empirical distributions, modes.
struct Steps {
  std::string label;
  std::vector<Point> points;
  Colour colour = Colour::kNext;
  Dash dash = Dash::kSolid;
};

enum class Mark { kCircle, kSquare, kDiamond, kTriangle, kCross };

struct Scatter {
  std::string label;
  std::vector<Point> points;
  Colour colour = Colour::kNext;
  Mark mark = Mark::kCircle;
  double size = 3.0;  ///< [px] half width of a mark, 0.5..20
};

/// The area between two curves over the same abscissae.
struct Band {
  struct Row {
    double x = 0.0;
    double low = 0.0;
    double high = 0.0;
  };
  std::string label;
  std::vector<Row> rows;
  Colour colour = Colour::kNext;
};

/// A filled polygon, closed by itself: cones, outlines. `filled` false: outline only.
struct Region {
  std::string label;
  std::vector<Point> points;
  Colour colour = Colour::kNext;
  bool filled = true;
};

/// A straight line across the whole chart, at x = value or at y = value.
struct Rule {
  std::string label;
  double value = 0.0;
  bool vertical = false;
  Colour colour = Colour::kGrey;
  Dash dash = Dash::kDashed;
};

/// From tail to head.
struct Arrow {
  std::string label;
  Point tail, head;
  Colour colour = Colour::kBlack;
};

/// Text beside a point.
struct Note {
  std::string text;
  Point at;
};

/// Values over a grid, coloured; with a bar that explains the colours. A cell reaches
/// half-way to its neighbours. `x` and `y` are ascending; `values` has one value per
/// cell, row by row: values[j * x.size() + i] belongs to (x[i], y[j]). A map whose sizes
/// disagree is not drawn. One per chart; drawn below everything else.
struct HeatMap {
  std::string label;  ///< of the colour bar, with unit
  std::vector<double> x, y, values;
  Scale scale = Scale::kLinear;  ///< of the colours
  std::string blank;             ///< what a hatched cell means; empty: not explained
};

using Series = std::variant<Line, Steps, Scatter, Band, Region, Rule, Arrow, Note>;

struct Chart {
  std::string title;
  std::string subtitle;  ///< one line of small print: what was asked
  AxisOptions x, y;
  bool equal_scales = false;  ///< a circle looks round: for shapes and cones
  std::vector<Series> series;
  std::optional<HeatMap> map;
  double width = 640.0;   ///< [px] 200..4000
  double height = 440.0;  ///< [px] 150..4000

  /// A complete SVG document.
  std::string svg() const;
};

/// CSS rules that turn the charts inside `root`, a selector, for a dark page: paper, ink,
/// edges and grid; of the colours of data only blue is lightened. They belong into
/// `@media screen and (prefers-color-scheme: dark)`. Their variables: --tint, --ink,
/// --soft, --line.
std::string dark_rules(const std::string& root);

/// Several charts on one sheet, row by row, `columns` >= 1 in a row.
std::string svg_of_sheet(const std::vector<Chart>& charts, int columns);

/// Corners of a sector of a ring, for cones of directions: radii >= 0, angles [rad]
/// counter-clockwise from `from` to `to`.
std::vector<Point> sector(const Point& centre, double inner, double outer, double from,
                          double to);

}  // namespace prehensile::plot
