/// SVG text, element by element: for charts, and for pictures elsewhere.
#pragma once

#include <string>
#include <string_view>

namespace prehensile::plot {

/// Of words and of black series.
inline constexpr const char* kInk = "#222222";

/// With `digits` decimals, no exponent; "-0" becomes "0". Not finite or beyond 1e300:
/// "0". Independent of the locale.
std::string fixed(double value, int digits);

/// The shortest decimal form that reads back as the same number.
std::string shortest(double value);

/// Pixels: two decimals, within +-1e5.
std::string px(double value);

/// Text as XML character data: markup escaped, characters that XML forbids left out,
/// invalid UTF-8 replaced.
std::string escaped(std::string_view text);

/// Width of a text [px], roughly: in DejaVu Sans, which stands in for the charts'
/// narrower fonts where these are missing.
double text_width(std::string_view text, double font_size);

/// Elements in the order in which they are drawn.
class Drawing {
 public:
  struct Stroke {
    std::string colour = "none";
    double width = 1.0;
    std::string dashes;  ///< as in SVG; empty: solid
  };

  enum class Anchor { kStart, kMiddle, kEnd };
  struct Font {
    double size = 12.0;
    bool bold = false;
    std::string colour = kInk;
    Anchor anchor = Anchor::kStart;
    bool upright = true;  ///< false: turned to run upwards
  };

  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const Stroke& stroke);
  void line(double x1, double y1, double x2, double y2, const Stroke& stroke);

  /// `data` is the path's d attribute.
  void path(const std::string& data, const std::string& fill, double opacity,
            const Stroke& stroke);
  void text(double x, double y, std::string_view words, const Font& font);

  /// Ready-made SVG.
  void raw(const std::string& svg) { out_ += svg; }

  const std::string& str() const { return out_; }

 private:
  std::string out_;
};

}  // namespace prehensile::plot
