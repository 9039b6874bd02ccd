/// Pages lead somewhere: every link, every file and every name in a file that a page
/// mentions is there, and the index leads to every page.
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/program.h"
#include "tests/docs/page.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PREHENSILE_SOURCE_DIR;

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern),
          std::sregex_iterator()};
}

/// As GitHub makes anchors of headings.
std::set<std::string> anchors_of(const std::string& text) {
  std::set<std::string> anchors;
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with('#')) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      } else if (c == ' ') {
        anchor += '-';
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Links, LeadToFilesAndHeadings) {
  const std::regex link(R"(\]\(([^)\s#]*)(#[^)\s]*)?\))");
  int checked = 0;
  for (const fs::path& page : pages()) {
    const std::string text = text_of_page(page);
    for (const std::smatch& match : matches(text, link)) {
      const std::string target = match[1];
      if (target.find("://") != std::string::npos) continue;
      const fs::path file =
          target.empty() ? kRoot / page : kRoot / page.parent_path() / target;
      EXPECT_TRUE(fs::exists(file)) << page << " leads to " << target;
      ++checked;
      if (!match[2].matched || !fs::is_regular_file(file)) continue;
      EXPECT_TRUE(anchors_of(read_text(file)).contains(match[2].str().substr(1)))
          << page << " leads to " << match[0];
    }
  }
  EXPECT_GE(checked, 100);
}

/// `folder/file.h` in a page is there.
TEST(Links, FilesThatAreMentionedExist) {
  const std::regex mention(
      R"(`([a-z_]+/[A-Za-z0-9_./]+\.(h|cpp|cmake|md|yaml|sh|csv|obj|json))`)");
  int checked = 0;
  for (const fs::path& page : pages()) {
    const std::string text = text_of_page(page);
    for (const std::smatch& match : matches(text, mention)) {
      const fs::path file = match[1].str();
      if (!fs::is_directory(kRoot / *file.begin())) continue;
      EXPECT_TRUE(fs::exists(kRoot / file)) << page << " mentions " << file;
      ++checked;
    }
  }
  EXPECT_GE(checked, 100);
}

/// "`name` in `file`", as the pages on adding things say it: the file has that name.
TEST(Links, NamesAreInTheFilesThatPagesSay) {
  const std::regex place(
      R"(`([A-Za-z_][A-Za-z_0-9:]*)(\(\))?`\s+in\s+\[?`([a-z_]+/[a-z_0-9/]+\.[a-zA-Z]+)`)");
  int checked = 0;
  for (const fs::path& page : pages()) {
    const std::string text = text_of_page(page);
    for (const std::smatch& match : matches(text, place)) {
      const std::string source = read_text(kRoot / match[3].str());
      EXPECT_NE(source.find(match[1].str()), std::string::npos)
          << page << ": " << match[1] << " is not in " << match[3];
      ++checked;
    }
  }
  EXPECT_GE(checked, 30);
}

TEST(Links, TheIndexLeadsToEveryPage) {
  const std::string index = read_text(kRoot / "docs/README.md");
  for (const fs::path& page : pages()) {
    if (*page.begin() != "docs" || page == "docs/README.md") continue;
    const std::string link = "](" + fs::relative(page, "docs").string() + ')';
    EXPECT_NE(index.find(link), std::string::npos) << "docs/README.md lacks " << page;
  }
}

}  // namespace
}  // namespace prehensile::testing
