// cut_run_with_arcs: a run of nodes as lines and upright arcs, whichever reach farther. Private to carve/.
//
// Like a line of fit_lines(), an arc is nowhere below the straight ways between the nodes' heights, and at most the
// tolerance above the nodes. Of all circles through its two ends one is taken that keeps to both at all nodes, if there
// is one: each node bounds the curvature from below and from above. Where the feed must fall because the way goes down,
// an arc that would be slower than lines is none.
#pragma once

#include "move_writer.hpp"
#include "node_run.hpp"

namespace passo {

void cut_run_with_arcs(MoveWriter& writer, const NodeLattice& lattice, const NodeRun& run, double tolerance);

}  // namespace passo
