/// The parts of `prehensile report`: the paper's figures computed again for the scenes of
/// problems/paper, its statements beside what is found, and the traps in its equations.
/// Everything on the page is computed when it is written, on one thread.
#pragma once

#include <string>
#include <vector>

#include "apps/report_page.h"
#include "apps/sweep.h"
#include "mechanics/model.h"

namespace prehensile::apps {

struct PaperScenes {
  Model slide, pivot, roll, prism;
};
PaperScenes paper_scenes();

/// A model of the scene with one field changed before it is prepared.
template <typename Change>
Model changed(const Model& model, const Change& change) {
  Scene scene = model.scene;
  change(scene);
  return prepare(scene);
}

/// One instant, as `query sweep` asks it. Throws std::runtime_error for an answer that is
/// not unique or fails its certificate: the report shows none of those.
SweepRow answered(const Model& model, const SweepQuestion& question = {});

/// `count` values from low to high.
std::vector<double> spaced(double low, double high, int count);

/// The `--set` that makes the pusher of the slide a point, for command lines.
extern const char* const kPointPusher;

void add_scene_table(ReportPage& page, const PaperScenes& scenes);
void add_slide_figures(ReportPage& page, const PaperScenes& scenes);  ///< Figs. 5 and 6
void add_pivot_figure(ReportPage& page, const PaperScenes& scenes);   ///< Fig. 8
void add_roll_figures(ReportPage& page, const PaperScenes& scenes);   ///< Fig. 9
void add_statements(ReportPage& page, const PaperScenes& scenes);
void add_traps(ReportPage& page, const PaperScenes& scenes);

/// The whole page.
std::string paper_report();

}  // namespace prehensile::apps
