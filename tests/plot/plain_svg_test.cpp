#include "plot/plain_svg.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "plot/chart.h"

namespace prehensile::plot {
namespace {

std::string with(const std::string& inside) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">" + inside +
         "</svg>\n";
}

TEST(PlainSvg, TakesEveryChart) {
  Chart chart;
  chart.title = "a < b & \"c\"; d: e";
  chart.x = {.label = "time [s]", .scale = Scale::kLog};
  Line line;
  line.label = "one";
  line.marks = true;
  line.points = {{1.0, 2.0}, {10.0, 3.0}};
  chart.series.emplace_back(line);
  EXPECT_EQ(fault_of_chart(chart.svg()), "");
  EXPECT_EQ(fault_of_chart(svg_of_sheet({chart, chart, chart}, 2)), "");
  EXPECT_EQ(fault_of_chart(with("<rect fill=\"url(#hatch0)\"/>")), "");
  int seen = 0;
  const std::filesystem::path folder = PREHENSILE_SOURCE_DIR "/docs/images";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename() == "overview.svg") continue;  // drawn by hand
    if (entry.path().extension() != ".svg") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string svg{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(fault_of_chart(svg), "") << entry.path();
    ++seen;
  }
  EXPECT_GE(seen, 5);
}

TEST(PlainSvg, RefusesWhatIsNoChart) {
  for (const char* inside : {"<script>alert(1)</script>",
                             "<style>* { fill: red }</style>",
                             "<foreignObject/>",
                             "<a href=\"http://x\"/>",
                             "<image href=\"x.png\"/>",
                             "<use href=\"#a\"/>",
                             "<rect onload=\"alert(1)\"/>",
                             "<rect style=\"fill:red\"/>",
                             "<rect fill=\"url(http://x/y)\"/>",
                             "<rect fill=\"URL(//x)\"/>",
                             "<rect fill=\"url(#a) url(b)\"/>",
                             "<rect fill=\"u\\72l(x)\"/>",
                             "<rect id=\"a b\"/>",
                             "<rect x=\"&#106;\"/>",
                             "<!-- words -->",
                             "<![CDATA[x]]>",
                             "<!DOCTYPE x>",
                             "<?php x?>",
                             "words",
                             "<text>&nbsp;</text>",
                             "<text>a > b</text>",
                             "<g><text></g></text>",
                             "<g>",
                             "<rect x=1/>",
                             "<rect x='1'/>",
                             "<rect x=\"1\"",
                             "<rect\tx=\"1\"/>",
                             "<svg xmlns=\"http://www.w3.org/1999/xhtml\"/>",
                             "<script",
                             "<g xlink:href=\"#a\"/>"}) {
    EXPECT_NE(fault_of_chart(with(inside)), "") << inside;
  }
  EXPECT_EQ(fault_of_chart(with("")), "");
  for (const std::string& text :
       {std::string(), std::string("words"), std::string("<g></g>"), with("") + with(""),
        "<html>" + with("") + "</html>", with("").substr(0, 40)}) {
    EXPECT_NE(fault_of_chart(text), "") << text;
  }
}

}  // namespace
}  // namespace prehensile::plot
