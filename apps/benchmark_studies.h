/// Studies of a suite as text, JSON and parts of a page.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/report_page.h"
#include "benchmarks/suite/summary.h"

namespace prehensile::apps {

/// A line for each study, then what each printed; nothing where there are none.
std::string describe_studies(const suite::Results& results);

nlohmann::ordered_json to_json(const suite::StudyRecord& record);

/// On stdout: runs and studies, as one JSON object or as tables for people.
void print_results(const suite::Results& results, const suite::Summary& summary,
                   bool as_json);

/// One JSON object on stdout; what is no UTF-8 in it is replaced.
void print_json(const nlohmann::ordered_json& json);

/// A section for each study: how it ended, its table, its charts. Charts that are no
/// charts of this software are left out, with the reason.
void add_studies(const suite::Results& results, ReportPage& page);

/// A line for each study that was to run and did not end well; empty: none.
std::string unsound_studies(const suite::Results& results);

}  // namespace prehensile::apps
