/// The tables of fields on docs/files.md are those of the schemas, which are those of the
/// readers (tests/io/schema_test.cpp).
#include "tests/docs/field_tables.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "tests/apps/program.h"
#include "tests/docs/page.h"

namespace prehensile::testing {
namespace {

TEST(FieldTables, AreMadeFromTheSchemas) {
  const std::string page = text_of_page("docs/files.md");
  const std::string fresh = with_fresh_tables(page);
  for (const char* kind : {"scene", "plan", "suite"}) {
    EXPECT_NE(
        page.find("<!-- fields of schemas/" + std::string(kind) + ".schema.json -->"),
        std::string::npos)
        << kind;
  }
  if (page == fresh) return;
  const auto file = std::filesystem::path(PREHENSILE_BINARY_DIR) / "files.md";
  write_text(file, fresh);
  ADD_FAILURE() << "docs/files.md is out of date: copy " << file << " over it";
}

TEST(FieldTables, SayTypeRangeUnitDefaultAndNeed) {
  const std::string tables = field_tables(R"({"properties": {
    "length": {"description": "Of it. [m]", "type": "number", "minimum": 0.5, "maximum": 2.0},
    "turn_deg": {"description": "About z. [degrees]", "type": "number", "default": 3.0},
    "turn": {"description": "The same.", "type": "number"},
    "way": {"description": "Which.", "enum": ["a", "b"], "default": "b"},
    "parts": {"description": "All.", "type": "array", "minItems": 0, "maxItems": 9,
      "items": {"properties": {"n": {"description": "It.", "type": "integer", "minimum": 1}}}}
    }, "required": ["length"]})");
  for (const char* row :
       {"| `length` | number, 0.5 to 2 m | required | Of it. |\n",
        "| `turn_deg`, or `turn` in radians | number degrees | `3` | About z. |\n",
        "| `way` | `a`, `b` | `b` | Which. |\n",
        "| `parts` | up to 9 maps, see below |  | All. |\n", "\n`parts[]`:\n\n",
        "| `n` | whole number, at least 1 |  | It. |\n"}) {
    EXPECT_NE(tables.find(row), std::string::npos) << row << "in\n" << tables;
  }
  EXPECT_EQ(tables.find("The same."), std::string::npos);
}

}  // namespace
}  // namespace prehensile::testing
