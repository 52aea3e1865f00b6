// cut_run_with_arcs: cuts a run of nodes as lines and vertical arcs, whichever cover more nodes. Private to carve/.
//
// Like a line of fit_lines(), an arc is nowhere below the straight lines between the nodes' heights, and at most the
// tolerance above the nodes. Among the circles through its two ends, one is chosen that satisfies both limits at all
// nodes, if there is one: each node limits the curvature from below and from above. If a descent would reduce the feed
// so far that an arc is slower than lines, lines are used.
#pragma once

#include "move_writer.hpp"
#include "node_run.hpp"

namespace passo {

void cut_run_with_arcs(MoveWriter& writer, const NodeLattice& lattice, const NodeRun& run, double tolerance);

}  // namespace passo
