#include "apps/report_page.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/table.h"
#include "plot/chart.h"

namespace prehensile::apps {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --paper: #fdfdfb; --ink: #1c1e21; --soft: #5b6168;
  --line: #d9dcd6; --tint: #f2f3ee; --good: #14693f; --part: #7a5600; --bad: #a3261b; }
@media screen and (prefers-color-scheme: dark) { :root { --paper: #15171a; --ink: #e6e7e3;
  --soft: #a2a8af; --line: #363a40; --tint: #1e2125; --good: #6fce9d; --part: #e3b75a;
  --bad: #f08d80; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.55 "Source Serif 4", Charter, "Bitstream Charter", Georgia, serif; }
main { max-width: 62rem; margin: 0 auto; padding: 2.5rem 1.25rem 5rem; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 3rem 0 .7rem; padding-top: 1rem;
  border-top: 1px solid var(--line); }
p { max-width: 44rem; margin: .6rem 0; }
nav { margin: 1.4rem 0 0; color: var(--soft); font-size: .95rem; }
nav a { margin-right: 1.1rem; white-space: nowrap; }
a { color: inherit; text-decoration-color: var(--soft); text-underline-offset: .2em; }
figure { margin: 1.6rem 0; }
figure .sheet { background: #ffffff; border: 1px solid var(--line); border-radius: 6px;
  padding: .5rem; overflow-x: auto; }
figure svg { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { color: var(--soft); font-size: .93rem; max-width: 44rem; margin-top: .6rem; }
.scroll { overflow-x: auto; margin: 1.2rem 0;  /* a shade where columns go on */
  background: linear-gradient(90deg, var(--paper) 40%, transparent) 0 0 / 2rem 100% local,
    linear-gradient(270deg, var(--paper) 40%, transparent) 100% 0 / 2rem 100% local,
    linear-gradient(90deg, var(--line), transparent) 0 0 / .8rem 100% scroll,
    linear-gradient(270deg, var(--line), transparent) 100% 0 / .8rem 100% scroll;
  background-repeat: no-repeat; }
.scroll:has(.objects) { position: relative; left: 50%; translate: -50%;
  width: max-content; min-width: 100%; max-width: calc(100vw - 4rem); }
table { border-collapse: collapse; width: 100%; font-size: .93rem; line-height: 1.45; }
th { text-align: left; font-weight: 600; color: var(--soft); white-space: nowrap; }
th, td { padding: .5rem .7rem .5rem 0; vertical-align: top;
  border-bottom: 1px solid var(--line); }
data { font-variant-numeric: tabular-nums; white-space: nowrap; }
code { font: .82rem/1.45 "JetBrains Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace;
  background: var(--tint); border-radius: 3px; padding: .05rem .25rem;
  overflow-wrap: anywhere; }
pre { font: .76rem/1.4 "JetBrains Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace;
  background: var(--tint); border-radius: 3px; padding: .5rem .7rem; margin: 0;
  width: fit-content; min-width: 100%; }
.statements td:nth-child(1) { width: 25%; } .statements td:nth-child(2) { width: 8%; }
.statements td:nth-child(4) { width: 8rem; }
.traps td:nth-child(1) { width: 30%; }
.objects { font-size: .86rem; }
.objects td, .objects code { white-space: nowrap; }
.objects th, .objects td { padding-right: .55rem; }
.where { color: var(--soft); white-space: nowrap; }
.confirmed, .done { color: var(--good); font-weight: 600; }
.limits { color: var(--part); font-weight: 600; }
.differs { color: var(--bad); font-weight: 600; }
.statements td code { display: block; margin-top: .4rem; padding: .25rem .4rem; }
figcaption code { display: block; margin-top: .5rem; padding: .25rem .4rem;
  width: fit-content; max-width: 100%; }
)css";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string ReportPage::number(const std::string& id, double value, const char* format) {
  if (!std::isfinite(value)) throw std::runtime_error("report: no value for " + id);
  if (std::find(ids_.begin(), ids_.end(), id) != ids_.end()) {
    throw std::runtime_error("report: two numbers are called " + id);
  }
  ids_.push_back(id);
  char shown[64];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(shown, sizeof shown, format, value);
#pragma GCC diagnostic pop
  std::string out = "<data id=\"" + id + "\" value=\"" + text("%.17g", value) + "\">";
  std::string words = shown;
  replace_all(words, "-", "\xe2\x88\x92");  // a minus sign, not a hyphen
  return out + words + "</data>";
}

void ReportPage::heading(const std::string& id, const std::string& words) {
  contents_.emplace_back(id, words);
  body_ += "<h2 id=\"" + id + "\">" + html(words) + "</h2>\n";
}

void ReportPage::paragraph(const std::string& inner) {
  body_ += "<p>" + inner + "</p>\n";
}

void ReportPage::table(const std::vector<std::vector<std::string>>& rows,
                       const std::string& kind) {
  body_ += "<div class=\"scroll\" tabindex=\"0\"><table";
  if (!kind.empty()) body_ += " class=\"" + kind + "\"";
  body_ += ">\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const char* cell = i == 0 ? "th" : "td";
    body_ += "<tr>";
    for (const std::string& inner : rows[i]) {
      body_ += std::string("<") + cell + '>' + inner + "</" + cell + '>';
    }
    body_ += "</tr>\n";
  }
  body_ += "</table></div>\n";
}

void ReportPage::printed(const std::string& words) {
  body_ += "<div class=\"scroll\"><pre>" + html(words) + "</pre></div>\n";
}

void ReportPage::figure(const std::string& id, const std::string& svg,
                        const std::string& caption) {
  std::string drawing = svg.substr(svg.find("<svg"));
  // Charts name their parts alike; on one page names must differ.
  replace_all(drawing, " id=\"", " id=\"" + id + "-");
  replace_all(drawing, "url(#", "url(#" + id + "-");
  body_ += "<figure id=\"" + id + "\"><div class=\"sheet\">" + drawing +
           "</div><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string ReportPage::str(const std::string& title, const std::string& lead) const {
  std::string out = "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" ";
  out += "lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
  // The page turns dark for screens, its charts with it.
  const std::string dark = "@media screen and (prefers-color-scheme: dark) {\n" +
                           plot::dark_rules("figure svg") +
                           "figure .sheet { background: var(--tint); }\n}\n";
  out += "<title>" + html(title) + "</title>\n<style>" + kStyle + dark;
  out += "</style>\n</head>\n";
  out += "<body>\n<main>\n<h1>" + html(title) + "</h1>\n" + lead + "<nav>";
  for (const auto& [id, words] : contents_) {
    out += "<a href=\"#" + id + "\">" + html(words) + "</a> ";
  }
  return out + "</nav>\n" + body_ + "</main>\n</body>\n</html>\n";
}

std::string html(const std::string& words) {
  std::string out = words;
  replace_all(out, "&", "&amp;");
  replace_all(out, "<", "&lt;");
  replace_all(out, ">", "&gt;");
  return out;
}

std::string code(const std::string& words) { return "<code>" + html(words) + "</code>"; }

}  // namespace prehensile::apps
