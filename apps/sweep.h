/// A sweep: one question asked for every combination of values of one or two fields, each
/// answer a row. What has no answer is a row too, with its status and reason.
#pragma once

#include <string>
#include <vector>

#include "apps/push_options.h"
#include "io/scene_file.h"

namespace prehensile::apps {

enum class SweepOf { kInstant, kPush, kRoll };

/// What every row asks. The swept fields replace members of this or fields of the scene.
struct SweepQuestion {
  SweepOf of = SweepOf::kInstant;
  PushOptions push;
  PathOptions path;  ///< of kPush, and the points per pad of all
  double speed_mm_s = 10.0;
  double turn_deg_s = 0.0;
  double height_mm = 0.0;
  double rise_mm_s = 0.0;
  std::string solver = "exact";  ///< of kInstant: exact, closed or spatial
};

/// A field and its values, as the option --over gives them.
struct SweptField {
  std::string path;  ///< of the scene as for --set, or an option of the query
  std::vector<std::string> values;
  std::vector<double> numbers;  ///< the values; their indices where they are no numbers
  bool is_numeric = true;
  bool is_log = false;
  bool is_of_query = false;
};

/// "path=from:to:count", "path=from:to:count:log" or "path=value,value,...". Throws
/// BadInput.
SweptField parse_swept_field(const std::string& text);

/// What a row tells.
struct SweepColumn {
  const char* key;              ///< in JSON and CSV
  const char* label;            ///< with unit
  bool is_of_question = false;  ///< known without, and whatever, the answer
};
const std::vector<SweepColumn>& sweep_columns(SweepOf of);

struct SweepRow {
  bool answered = false;  ///< a unique answer; else `status` and `reason` say why not
  std::string status;
  std::string reason;
  std::vector<double> values;  ///< by column, NaN where there is none; also set where the
                               ///< answer is one of several
};

struct Sweep {
  SweepQuestion question;
  std::vector<SweptField> fields;  ///< one or two
  std::vector<SweepRow> rows;      ///< the first field changes fastest

  int columns() const { return static_cast<int>(fields.front().values.size()); }
  int lines() const {
    return fields.size() > 1 ? static_cast<int>(fields.back().values.size()) : 1;
  }
  const SweepRow& row(int column, int line) const {
    return rows[line * columns() + column];
  }
};

/// Asks one question. Throws BadInput.
SweepRow ask(const Model& model, const SweepQuestion& question);

/// Fills the rows on `jobs` threads; the same rows for any number of them. A row of bad
/// input is a row like others, unless all are: then throws the BadInput of the first.
void run_sweep(Sweep& sweep, const SceneFile& file, const SceneOptions& scene, int jobs);

}  // namespace prehensile::apps
