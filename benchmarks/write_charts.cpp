#include "benchmarks/write_charts.h"

#include <cstdio>

#include "plot/chart.h"

namespace prehensile::benchmarks {

bool write_error_charts(const std::vector<ErrorChart>& charts, const char* cost_label,
                        const std::string& file) {
  std::vector<plot::Chart> sheet;
  for (const ErrorChart& chart : charts) {
    plot::Chart drawn;
    drawn.title = chart.title;
    drawn.x = {.label = cost_label, .scale = plot::Scale::kLog};
    drawn.y = {.label = "error of the end pose [m]", .scale = plot::Scale::kLog};
    for (const ErrorChart::Line& line : chart.lines) {
      plot::Line series;
      series.label = line.label;
      series.marks = true;
      for (const auto& [cost, error] : line.points) {
        series.points.push_back({cost, error});
      }
      drawn.series.emplace_back(series);
    }
    sheet.push_back(drawn);
  }
  const std::string text = plot::svg_of_sheet(sheet, 3);
  const std::string temporary = file + ".part";
  std::FILE* out = std::fopen(temporary.c_str(), "w");
  bool written = out != nullptr;
  if (out) {
    written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    written = std::fclose(out) == 0 && written;
  }
  written = written && std::rename(temporary.c_str(), file.c_str()) == 0;
  if (!written) std::fprintf(stderr, "error: cannot write %s\n", file.c_str());
  return written;
}

}  // namespace prehensile::benchmarks
