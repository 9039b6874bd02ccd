#include "plot/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace prehensile::plot {
namespace {

/// Length of the UTF-8 character at the start of `text`; 0 if it is not one that XML
/// allows.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
  };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  std::uint32_t code = lead & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  static constexpr std::array<std::uint32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  const bool forbidden = code > 0x10ffff || code == 0xfffe || code == 0xffff;
  return code < kLeast[length] || surrogate || forbidden ? 0 : length;
}

std::string attribute(const char* name, const std::string& value) {
  std::string out = " ";
  out += name;
  out += "=\"";
  out += value;
  out += '"';
  return out;
}

std::string attributes(const Drawing::Stroke& stroke) {
  std::string out = attribute("stroke", stroke.colour);
  if (stroke.colour == "none") return out;
  out += attribute("stroke-width", fixed(stroke.width, 2));
  if (!stroke.dashes.empty()) out += attribute("stroke-dasharray", stroke.dashes);
  return out;
}

}  // namespace

std::string fixed(double value, int digits) {
  if (!(std::abs(value) <= 1e300)) value = 0.0;
  std::array<char, 512> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                    std::chars_format::fixed, std::clamp(digits, 0, 20));
  std::string out(buffer.data(), error == std::errc() ? end : buffer.data());
  const bool zero = out.find_first_of("123456789") == std::string::npos;
  if (zero && out.starts_with('-')) out.erase(0, 1);
  return out;
}

std::string shortest(double value) {
  std::array<char, 64> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), error == std::errc() ? end : buffer.data()};
}

std::string px(double value) {
  return fixed(std::isnan(value) ? 0.0 : std::clamp(value, -1e5, 1e5), 2);
}

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const char c = text.front();
    if (length == 0) {
      out += "\xef\xbf\xbd";
    } else if (length > 1) {
      out += text.substr(0, length);
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\n' || c == '\t' || c == '\r') {
      out += ' ';
    } else if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      out += c;
    }
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return out;
}

double text_width(std::string_view text, double font_size) {
  double ems = 0.0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0U) == 0x80U) continue;
    const bool narrow =
        std::string_view("iljtfr.,:;|!'()[] ").find(c) != std::string::npos;
    const bool wide = std::string_view("mwMW%").find(c) != std::string::npos;
    const bool capital = c >= 'A' && c <= 'Z';
    ems += narrow ? 0.36 : wide ? 0.95 : capital ? 0.72 : 0.62;
  }
  return ems * font_size;
}

void Drawing::rectangle(double x, double y, double width, double height,
                        const std::string& fill, const Stroke& stroke) {
  out_ += "<rect";
  out_ += attribute("x", px(x)) + attribute("y", px(y));
  out_ += attribute("width", px(std::max(0.0, width)));
  out_ += attribute("height", px(std::max(0.0, height)));
  out_ += attribute("fill", fill) + attributes(stroke) + "/>\n";
}

void Drawing::line(double x1, double y1, double x2, double y2, const Stroke& stroke) {
  out_ += "<line";
  out_ += attribute("x1", px(x1)) + attribute("y1", px(y1));
  out_ += attribute("x2", px(x2)) + attribute("y2", px(y2));
  out_ += attributes(stroke) + "/>\n";
}

void Drawing::path(const std::string& data, const std::string& fill, double opacity,
                   const Stroke& stroke) {
  out_ += "<path";
  out_ += attribute("d", data) + attribute("fill", fill);
  if (opacity < 1.0) out_ += attribute("fill-opacity", fixed(opacity, 2));
  out_ += attributes(stroke) + attribute("stroke-linejoin", "round") + "/>\n";
}

void Drawing::text(double x, double y, std::string_view words, const Font& font) {
  static constexpr std::array<const char*, 3> kAnchors = {"start", "middle", "end"};
  out_ += "<text";
  out_ += attribute("x", px(x)) + attribute("y", px(y));
  out_ += attribute("font-size", fixed(font.size, 1)) + attribute("fill", font.colour);
  out_ += attribute("text-anchor", kAnchors[static_cast<std::size_t>(font.anchor)]);
  if (font.bold) out_ += attribute("font-weight", "bold");
  if (!font.upright) {
    out_ += attribute("transform", "rotate(-90 " + px(x) + ' ' + px(y) + ')');
  }
  out_ += '>' + escaped(words) + "</text>\n";
}

}  // namespace prehensile::plot
