/// Colours of series and of heat maps. Internal to the plot layer.
#pragma once

#include <string>

#include "plot/chart.h"
#include "plot/svg.h"

namespace prehensile::plot {

/// "#rrggbb" of a colour that is not kNext or kSame. Source: the palette of Okabe and
/// Ito, its yellow darkened for lines on white.
std::string hex(Colour colour);

/// How many colours there are for series that do not choose theirs, and the n-th, n >= 0:
/// they begin anew where they end.
inline constexpr int kColourCount = 7;
Colour nth_colour(int n);

/// What is no data: drawn on paper, in ink (svg.h) and its paler kinds.
inline constexpr const char* kPaper = "#ffffff";
inline constexpr const char* kEdgeInk = "#444444";
inline constexpr const char* kSoftInk = "#666666";
inline constexpr const char* kFaintInk = "#888888";
inline constexpr const char* kGridInk = "#e4e4e4";
inline constexpr const char* kHatchPaper = "#f4f4f4";
inline constexpr const char* kHatchInk = "#bbbbbb";

/// "#rrggbb" at a share of the scale, clamped to [0, 1]: dark blue over green to yellow,
/// lightness rising all the way, so that it also reads in grey.
std::string map_colour(double share);

}  // namespace prehensile::plot
