/// A self-contained HTML page: text, tables and charts, nothing from the network. It is
/// well-formed XML as well, so that programs can read it back.
///
/// Every number that was computed is a <data> element with an id and its full value.
#pragma once

#include <string>
#include <vector>

#include "plot/chart.h"

namespace prehensile::apps {

class ReportPage {
 public:
  /// HTML of a computed number: `format` is of printf for what people see. Ids are
  /// unique. Throws std::runtime_error for a number that is not finite: a report does not
  /// show what was not found.
  std::string number(const std::string& id, double value, const char* format = "%.4g");

  void heading(const std::string& id, const std::string& words);
  void paragraph(const std::string& html);
  /// Cells are HTML; the first row is the header.
  void table(const std::vector<std::vector<std::string>>& rows,
             const std::string& kind = "");
  /// Lines of a terminal, as they are.
  void printed(const std::string& words);
  void figure(const std::string& id, const std::string& svg, const std::string& caption);

  /// The whole page; `lead` is HTML under the title.
  std::string str(const std::string& title, const std::string& lead) const;

 private:
  std::string body_;
  std::vector<std::string> ids_;
  std::vector<std::pair<std::string, std::string>> contents_;
};

/// Text as HTML.
std::string html(const std::string& words);

/// A command line in its own type.
std::string code(const std::string& words);

}  // namespace prehensile::apps
