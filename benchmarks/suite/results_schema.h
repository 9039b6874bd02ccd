/// Tables of a file of results. Internal to the suite.
#pragma once

#include <string>

#include "benchmarks/suite/database.h"
#include "benchmarks/suite/results.h"

namespace prehensile::suite {

/// Creates the tables and writes everything but the rows.
void write_header(Database& database, const Results& header);

/// Everything but the rows; BadInput for other databases.
Results read_header(Database& database, const std::filesystem::path& file);

/// "a, b, c" of the columns of `runs` behind the key: status, solved, and those of
/// visit_columns.
std::string value_columns();
inline constexpr const char* kKeyColumns =
    "experimentid, plannerid, problem, seed, repetition";
inline constexpr int kKeyColumnCount = 5;

void bind_row(Statement& statement, const ResultRow& row);
ResultRow read_row(const Statement& statement);  ///< key, then values, from column 0

}  // namespace prehensile::suite
