/// Studies in a file of results: tables of their own, which files of suites without
/// studies, and older ones, may lack. Internal to the suite.
#pragma once

#include <set>
#include <vector>

#include "benchmarks/suite/database.h"
#include "benchmarks/suite/study_record.h"

namespace prehensile::suite {

/// Makes the tables where they are missing.
void make_study_tables(Database& database);

/// By their place in the suite. Throws BadInput for rows that no program of ours writes.
std::vector<StudyRecord> read_studies(Database& database,
                                      const std::filesystem::path& file);

/// Those whose programs have run.
std::set<int> studies_that_ran(Database& database);

/// Adds one, in place of one that had not run; false if it is there. In the transaction
/// of the caller.
bool write_study(Database& database, const StudyRecord& record);

}  // namespace prehensile::suite
