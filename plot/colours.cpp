#include "plot/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prehensile::plot {
namespace {

constexpr const char* kBlue = "#0072b2";  // the one of the palette that is dark

using Rgb = std::array<double, 3>;

std::string hex_of(const Rgb& rgb) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out = "#";
  for (const double part : rgb) {
    const int value = std::clamp(static_cast<int>(std::lround(part)), 0, 255);
    out += kDigits[value / 16];
    out += kDigits[value % 16];
  }
  return out;
}

}  // namespace

std::string hex(Colour colour) {
  switch (colour) {
    case Colour::kNext:
    case Colour::kSame:
    case Colour::kBlue:
      return kBlue;
    case Colour::kOrange:
      return "#e69f00";
    case Colour::kGreen:
      return "#009e73";
    case Colour::kPurple:
      return "#cc79a7";
    case Colour::kSky:
      return "#56b4e9";
    case Colour::kRed:
      return "#d55e00";
    case Colour::kYellow:
      return "#c9b800";
    case Colour::kBlack:
      return kInk;
    case Colour::kGrey:
      return kFaintInk;
  }
  return kInk;
}

Colour nth_colour(int n) {
  static constexpr std::array<Colour, kColourCount> kOrder = {
      Colour::kBlue, Colour::kRed,    Colour::kGreen, Colour::kPurple,
      Colour::kSky,  Colour::kOrange, Colour::kYellow};
  return kOrder[static_cast<std::size_t>(n) % kOrder.size()];
}

std::string dark_rules(const std::string& root) {
  static constexpr std::array<std::array<const char*, 2>, 9> kTurned = {
      {{kBlue, "#2b8ed0"},
       {kPaper, "var(--tint)"},
       {kInk, "var(--ink)"},
       {kEdgeInk, "var(--soft)"},
       {kSoftInk, "var(--soft)"},
       {kFaintInk, "var(--soft)"},
       {kGridInk, "var(--line)"},
       {kHatchPaper, "var(--tint)"},
       {kHatchInk, "var(--soft)"}}};
  std::string out;
  for (const auto& [light, dark] : kTurned) {
    for (const std::string part : {"fill", "stroke"}) {
      out += root + " [" + part + "=\"" + light + "\"] { " + part + ": " + dark + "; }\n";
    }
  }
  return out;
}

std::string map_colour(double share) {
  static constexpr std::array<Rgb, 7> kStops = {{{48.0, 18.0, 92.0},
                                                 {45.0, 67.0, 135.0},
                                                 {33.0, 110.0, 143.0},
                                                 {32.0, 150.0, 139.0},
                                                 {76.0, 188.0, 112.0},
                                                 {168.0, 216.0, 64.0},
                                                 {250.0, 232.0, 60.0}}};
  const double at =
      (std::isnan(share) ? 0.0 : std::clamp(share, 0.0, 1.0)) * (kStops.size() - 1.0);
  const std::size_t stop = std::min(kStops.size() - 2, static_cast<std::size_t>(at));
  const double rest = at - static_cast<double>(stop);
  Rgb rgb;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    rgb[i] = (1.0 - rest) * kStops[stop][i] + rest * kStops[stop + 1][i];
  }
  return hex_of(rgb);
}

}  // namespace prehensile::plot
