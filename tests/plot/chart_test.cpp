#include "plot/chart.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "plot/colours.h"
#include "plot/svg.h"
#include "problems/random_stream.h"
#include "tests/plot/svg_text.h"

namespace prehensile::plot {
namespace {

using testing::count_of;
using testing::fault_of_svg;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One series of every kind around these points.
std::vector<Series> one_of_each(const std::vector<Point>& points) {
  Band band{.label = "band"};
  for (const Point& p : points) band.rows.push_back({p.x, p.y - 1.0, p.y + 1.0});
  const Point first = points.empty() ? Point{} : points.front();
  const Point last = points.empty() ? Point{} : points.back();
  return {band,
          Line{.label = "line", .points = points, .marks = true},
          Steps{.label = "steps", .points = points, .dash = Dash::kDotted},
          Scatter{.label = "scatter", .points = points, .mark = Mark::kCross},
          Region{.label = "region", .points = points},
          Rule{.label = "rule", .value = first.y},
          Arrow{.label = "arrow", .tail = first, .head = last},
          Note{.text = "note", .at = first}};
}

TEST(Chart, IsWellFormedAndShowsEverySeries) {
  Chart chart{.title = "title", .subtitle = "small print"};
  chart.x.label = "x [m]";
  chart.series = one_of_each({{0.0, 1.0}, {1.0, 3.0}, {2.0, 2.0}});
  const std::string svg = chart.svg();
  EXPECT_EQ(fault_of_svg(svg), "");
  for (const char* label :
       {"line", "steps", "scatter", "band", "region", "rule", "arrow", "note"}) {
    EXPECT_EQ(count_of(svg, std::string(label) + "</text>"), 1) << label;
  }
  EXPECT_EQ(svg.find("nothing to draw"), std::string::npos);
}

TEST(Chart, NamesStandInsteadOfNumbers) {
  Chart chart{.series = {Scatter{.points = {{1.0, 0.0}, {2.0, 1.0}, {3.0, 2.0}}}}};
  chart.y.names = {"low", "middle", "high", "beyond the data"};
  const std::string svg = chart.svg();
  EXPECT_EQ(fault_of_svg(svg), "");
  const auto height_of = [&svg](const std::string& name) {
    const std::size_t text = svg.find('>' + name + "</text>");
    EXPECT_NE(text, std::string::npos) << name;
    const std::size_t y = svg.rfind(" y=\"", text);
    return std::stod(svg.substr(y + 4));
  };
  EXPECT_GT(height_of("low"), height_of("middle"));
  EXPECT_GT(height_of("middle"), height_of("high"));
  EXPECT_EQ(svg.find("beyond the data"), std::string::npos);
}

/// Measured by a browser in the widest of the fonts that a viewer may take.
TEST(Chart, LegendsHaveRoomForTheirText) {
  for (const auto& [text, ems] :
       {std::pair{"line 30 mm, disc of radius 10 mm and 9 alike", 22.63},
        std::pair{"siconos-nsn-fb, R = 0.01", 12.25}, std::pair{"not unique", 5.38}}) {
    EXPECT_GE(text_width(text, 12.0), 12.0 * ems) << text;
    EXPECT_LE(text_width(text, 12.0), 12.0 * 1.1 * ems) << text;
  }
}

/// Where the colours are used up, marks and dashes tell series apart.
TEST(Chart, NoTwoOfManySeriesLookAlike) {
  const std::vector<Point> points = {{0.0, 1.0}, {1.0, 2.0}};
  const auto looks_of = [&](const Series& series) {
    Chart chart{.series = std::vector<Series>(3 * kColourCount, series)};
    const std::string svg = chart.svg();
    std::map<std::string, int> looks;  // without the places of keys, which are no curves
    std::size_t at = svg.find("<g clip-path");
    const std::size_t end = svg.find("</g>", at);
    for (at = svg.find('<', at + 1); at < end; at = svg.find('<', at + 1)) {
      ++looks[svg.substr(at, svg.find('>', at) - at)];
    }
    return looks;
  };
  EXPECT_EQ(looks_of(Line{.points = points}).size(), 3U * kColourCount);
  EXPECT_EQ(looks_of(Steps{.points = points}).size(), 3U * kColourCount);
  EXPECT_EQ(looks_of(Scatter{.points = points}).size(), 3U * kColourCount);
  // The lines of each round look alike, their marks do not.
  const int marks = 2 * 3 * kColourCount;
  EXPECT_EQ(looks_of(Line{.points = points, .marks = true}).size(),
            static_cast<std::size_t>(kColourCount + marks));
}

TEST(Chart, SeriesThatBelongTogetherShareAColour) {
  const std::vector<Point> points = {{0.0, 1.0}, {1.0, 2.0}};
  const Chart chart{
      .series = {Line{.points = points},
                 Scatter{.points = points, .colour = Colour::kSame, .mark = Mark::kCross},
                 Line{.points = points}}};
  const std::string svg = chart.svg();
  EXPECT_EQ(count_of(svg, "\"" + hex(nth_colour(0)) + '"'), 2);
  EXPECT_EQ(count_of(svg, "\"" + hex(nth_colour(1)) + '"'), 1);
}

/// Every grey of a chart, found in its text, has a rule for dark pages.
TEST(Chart, DarkRulesLeaveNoGreyOut) {
  Chart chart{.title = "title", .subtitle = "small print", .series = one_of_each({})};
  chart.map = HeatMap{.label = "map",
                      .x = {0.0, 1.0},
                      .y = {0.0, 1.0},
                      .values = {0.0, 1.0, 2.0, kNan},
                      .blank = "blank"};
  Chart empty;
  Chart lines{.series = one_of_each({{0.0, 1.0}, {1.0, 3.0}})};
  const std::string svg = chart.svg() + empty.svg() + lines.svg();
  const std::string rules = dark_rules("figure");
  int greys = 0;
  for (std::size_t at = svg.find("\"#"); at != std::string::npos;
       at = svg.find("\"#", at + 1)) {
    const std::string colour = svg.substr(at + 2, 6);
    if (colour.substr(0, 2) != colour.substr(2, 2)) continue;
    if (colour.substr(0, 2) != colour.substr(4, 2)) continue;
    ++greys;
    EXPECT_NE(rules.find("figure [fill=\"#" + colour), std::string::npos) << colour;
    EXPECT_NE(rules.find("figure [stroke=\"#" + colour), std::string::npos) << colour;
  }
  EXPECT_GT(greys, 40);
}

TEST(Chart, TheReaderOfTheTestsFindsFaults) {
  for (const char* bad : {"<a>", "<a></b>", "<a b=1/>", "<a>&</a>", "<a x=\"nan\"/>",
                          "<a/><b/>", "", "<a x=\"1\" x=\"2\"/>"}) {
    EXPECT_NE(fault_of_svg(bad), "") << bad;
  }
}

TEST(Chart, TextIsEscaped) {
  Chart chart{.title = "a < b & \"c\" > d",
              .subtitle = "bad \xff\xc0\xaf \x01 bytes, µm"};
  chart.series = {Line{.label = "<script>", .points = {{0.0, 0.0}, {1.0, 1.0}}}};
  const std::string svg = chart.svg();
  EXPECT_EQ(fault_of_svg(svg), "");
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; d"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_EQ(svg.find('\x01'), std::string::npos);
  EXPECT_NE(svg.find("µm"), std::string::npos);
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Chart, WithoutDataSaysSo) {
  for (const std::vector<Point>& points :
       {std::vector<Point>{}, std::vector<Point>{{kNan, 1.0}, {kInfinity, kNan}}}) {
    Chart chart;
    chart.series = {Line{.points = points}, Scatter{.points = points},
                    Steps{.points = points}, Region{.points = points}};
    const std::string svg = chart.svg();
    EXPECT_EQ(fault_of_svg(svg), "");
    EXPECT_NE(svg.find("nothing to draw"), std::string::npos);
  }
  EXPECT_EQ(fault_of_svg(svg_of_sheet({}, 3)), "");
}

TEST(Chart, LinesBreakAtWhatCannotBeDrawn) {
  Chart chart;
  chart.series = {
      Line{.points = {{0.0, 0.0}, {1.0, 1.0}, {2.0, kNan}, {3.0, 1.0}, {4.0, 2.0}},
           .colour = Colour::kRed}};
  const std::string svg = chart.svg();
  const std::size_t from = svg.find("d=\" M");
  ASSERT_NE(from, std::string::npos);
  const std::string data = svg.substr(from, svg.find('"', from + 3) - from);
  EXPECT_EQ(count_of(data, "M"), 2) << data;
  EXPECT_EQ(count_of(data, "L"), 2) << data;
}

TEST(Chart, ExtremeNumbersStayNumbers) {
  RandomStream random(11);
  for (int i = 0; i < 400; ++i) {
    Chart chart;
    chart.x.scale = random.chance(0.5) ? Scale::kLog : Scale::kLinear;
    chart.y.scale = random.chance(0.5) ? Scale::kLog : Scale::kLinear;
    chart.equal_scales = random.chance(0.3);
    chart.width = random.chance(0.1) ? kNan : random.in(-100.0, 9000.0);
    chart.height = random.chance(0.1) ? kInfinity : random.in(-100.0, 9000.0);
    if (random.chance(0.3)) chart.x.low = random.in(-1.0, 1.0);
    if (random.chance(0.3)) chart.y.high = random.log_in(1e-310, 1e308);
    std::vector<Point> points(static_cast<std::size_t>(random.below(6)));
    const auto value = [&] {
      if (random.chance(0.1)) return kNan;
      if (random.chance(0.1)) return kInfinity;
      return (random.chance(0.3) ? -1.0 : 1.0) * random.log_in(1e-310, 1e308);
    };
    for (Point& point : points) point = {value(), value()};
    chart.series = one_of_each(points);
    if (random.chance(0.3)) {
      chart.map = HeatMap{.x = {1.0, 2.0},
                          .y = {1.0},
                          .values = {value(), value()},
                          .scale = random.chance(0.5) ? Scale::kLog : Scale::kLinear};
    }
    ASSERT_EQ(fault_of_svg(chart.svg()), "") << i;
  }
}

TEST(Chart, PointsAreWhereTheAxesSay) {
  Chart chart;
  chart.x = {.low = 0.0, .high = 10.0};
  chart.y = {.low = 0.0, .high = 10.0};
  chart.series = {Line{.points = {{0.0, 0.0}, {10.0, 10.0}, {5.0, 5.0}}}};
  const std::string svg = chart.svg();
  const std::size_t from = svg.find("d=\" M") + 5;
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(svg.c_str() + from, "%lf %lf L%lf %lf L%lf %lf", &x[0], &y[0],
                        &x[1], &y[1], &x[2], &y[2]),
            6);
  EXPECT_LT(x[0], x[1]);
  EXPECT_GT(y[0], y[1]);
  EXPECT_NEAR(x[2], 0.5 * (x[0] + x[1]), 0.02);
  EXPECT_NEAR(y[2], 0.5 * (y[0] + y[1]), 0.02);
}

TEST(Chart, EqualScalesMakeACircleRound) {
  Chart chart{.equal_scales = true, .width = 700.0, .height = 300.0};
  chart.series = {Region{.points = {{-1.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}}}};
  const std::string svg = chart.svg();
  double x[4], y[4];
  const std::size_t from = svg.find("d=\" M") + 5;
  ASSERT_EQ(std::sscanf(svg.c_str() + from, "%lf %lf L%lf %lf L%lf %lf L%lf %lf", &x[0],
                        &y[0], &x[1], &y[1], &x[2], &y[2], &x[3], &y[3]),
            8);
  EXPECT_NEAR(x[2] - x[0], y[1] - y[3], 0.05);
}

TEST(Chart, MapsDrawEveryCellAndExplainBlankOnes) {
  Chart chart;
  chart.map = HeatMap{.label = "force [N]",
                      .x = {1.0, 2.0, 3.0},
                      .y = {0.1, 1.0},
                      .values = {1.0, 2.0, 3.0, kNan, 5.0, 6.0},
                      .blank = "falls"};
  chart.y.scale = Scale::kLog;
  const std::string svg = chart.svg();
  EXPECT_EQ(fault_of_svg(svg), "");
  EXPECT_EQ(count_of(svg, "url(#hatch0)"), 2);  // the cell and the legend
  EXPECT_NE(svg.find("falls"), std::string::npos);
  EXPECT_NE(svg.find("force [N]"), std::string::npos);
  EXPECT_NE(svg.find(map_colour(0.0)), std::string::npos);
  EXPECT_NE(svg.find(map_colour(1.0)), std::string::npos);
  chart.map->values.pop_back();
  EXPECT_NE(chart.svg().find("nothing to draw"), std::string::npos);
}

TEST(Sheet, HasItsOwnIdsPerChart) {
  Chart chart;
  chart.series = {Line{.points = {{0.0, 0.0}, {1.0, 1.0}}}};
  const std::string svg = svg_of_sheet({chart, chart, chart}, 2);
  EXPECT_EQ(fault_of_svg(svg), "");
  for (const char* id : {"id=\"clip0\"", "id=\"clip1\"", "id=\"clip2\""}) {
    EXPECT_EQ(count_of(svg, id), 1);
  }
}

TEST(Colours, AreDistinctAndMapsGrowLighter) {
  double last = -1.0;
  for (int k = 0; k <= 20; ++k) {
    int r = 0, g = 0, b = 0;
    ASSERT_EQ(std::sscanf(map_colour(k / 20.0).c_str(), "#%2x%2x%2x", &r, &g, &b), 3);
    const double lightness = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    EXPECT_GT(lightness, last);
    last = lightness;
  }
  EXPECT_NE(hex(nth_colour(0)), hex(nth_colour(1)));
}

TEST(Sector, HasItsAreaAndRadii) {
  const std::vector<Point> cone = sector({1.0, 2.0}, 0.5, 1.0, 0.0, std::numbers::pi / 2);
  double area = 0.0;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Point& a = cone[i];
    const Point& b = cone[(i + 1) % cone.size()];
    area += 0.5 * (a.x * b.y - b.x * a.y);
    const double r = std::hypot(a.x - 1.0, a.y - 2.0);
    EXPECT_TRUE(std::abs(r - 0.5) < 1e-12 || std::abs(r - 1.0) < 1e-12);
  }
  EXPECT_NEAR(area, std::numbers::pi / 4 * 0.75, 1e-3);
}

}  // namespace
}  // namespace prehensile::plot
