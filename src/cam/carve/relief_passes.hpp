// The common basis of the passes of a relief program: the writer, the lattice, and the approach of a cutter to its
// work.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "level_lines.hpp"
#include "level_path.hpp"
#include "move_writer.hpp"
#include "node_mask.hpp"
#include "node_run.hpp"
#include "parallel_rows.hpp"
#include "stock_in_work.hpp"

#include "passo/carve/dropped_cutter.hpp"
#include "passo/carve/relief_program.hpp"

namespace passo {

// Records the tip positions at nodes, for the view of the carved surface.
class TipRecord {
 public:
  TipRecord(const HeightGrid& surface, std::size_t margin_x, std::size_t margin_y);

  void add(const NodeLattice& lattice, const NodeRun& run);
  // Adds a toolpath between nodes at the nearest nodes, where the tip is no lower than it may be there.
  void add(const std::vector<CarvedCut>& way, const NodeLattice& lattice, const TipSurface& surface);
  // Lowers `carved` to the surface that the cutter has left.
  void carve(const Cutter& cutter, unsigned threads, CarvedSurface& carved) const;

 private:
  std::ptrdiff_t margin_x_;
  std::ptrdiff_t margin_y_;
  HeightGrid depths_;  // tip depths below zero
};

class ReliefPass {
 public:
  ReliefPass(MoveWriter& writer, const ReliefProgramOptions& options) : writer_(writer), options_(options) {}

  MoveWriter& writer() { return writer_; }
  const ReliefProgramOptions& options() const { return options_; }

  void set_lattice(const NodeLattice& lattice) { lattice_ = lattice; }
  const NodeLattice& lattice() const { return lattice_; }
  void set_record(TipRecord* record) { record_ = record; }
  // The stock that the writer's moves cut. Null: the stock is not tracked.
  void set_stock(StockInWork* stock) { stock_ = stock; }
  StockInWork* stock() const { return stock_; }

  // Lifts the tool, moves to the run's first node, and enters the stock there. At `free_above` and higher there is no
  // stock.
  void go_to_work(const NodeRun& run, double free_above);
  // Cuts along the run. The tool must be at its first node.
  void cut(const NodeRun& run);
  void lift();

  // Returns the tool's position, in mm from node (0, 0).
  FlatPlace flat_place() const { return flat(writer_.place()); }

  // How the tool may approach a toolpath.
  struct WayEntry {
    double near = 0;        // mm; a toolpath that begins within this distance is approached without lifting if nothing
                            // is in between
    bool sideways = false;  // enters at full depth from the side; the stock there is at most one stepover wide
    bool is_for_stock = false;  // skips a toolpath above which there is no stock
    // The ramp begins where the inner half of the cutter touches the stock: the rest is cut by the rim, as between two
    // neighbouring toolpaths.
    bool cuts_with_rim = false;
    // The ramp ends at the height of the start, and only the stock at the start matters, because the path cuts the
    // rest.
    bool is_row = false;
  };
  // Approaches a toolpath of lines and arcs, descends along it, and cuts all of it. Requires the stock.
  void cut_way(const LevelPath& path, const TipSurface& surface, const WayEntry& entry);
  // Cuts a toolpath that begins at the XY position of the tool, above or below it.
  void follow(const LevelPath& path, const TipSurface& surface);

 private:
  FlatPlace flat(const CarvedPlace& place) const;
  void approach(const CarvedPlace& place, double free_above);
  void emit(CarvedCut cut, std::int64_t z);
  std::size_t ramp_down(const LevelPath& path, double from, double to);
  void ramp_in(const NodeRun& run, double free_above, std::size_t nodes);

  MoveWriter& writer_;
  const ReliefProgramOptions& options_;
  NodeLattice lattice_;
  TipRecord* record_ = nullptr;
  StockInWork* stock_ = nullptr;
  bool is_at_work_ = false;  // this cutter is cutting, at a known position
};

// Rows of runs at one depth, in an order in which one can follow the other without lifting.
//
// wants(column, row): whether the cutter has work there. height(column, row): the gouge-free tip height there.
// free_above(column, row): the height above which there is no stock at that node.
class AreaSweep {
 public:
  struct Area {
    std::ptrdiff_t first_column = 0;
    std::ptrdiff_t end_column = 0;
    std::ptrdiff_t first_row = 0;
    std::ptrdiff_t end_row = 0;
    std::ptrdiff_t step = 1;                // between rows of work
    std::vector<std::ptrdiff_t> rows = {};  // the rows of work, if they are not `step` apart
    std::ptrdiff_t gap = 0;                 // joins runs at most this far apart
    int direction = 0;  // 1 or -1: all runs go to higher or lower columns; 0: one run follows the other
  };
  using Wants = std::function<bool(std::ptrdiff_t column, std::ptrdiff_t row)>;
  using Height = std::function<float(std::ptrdiff_t column, std::ptrdiff_t row)>;

  AreaSweep(ReliefPass& pass, const Area& area, Wants wants, Height height, Height free_above)
      : pass_(pass),
        area_(area),
        wants_(std::move(wants)),
        height_(std::move(height)),
        free_above_(std::move(free_above)) {}

  void cut(const std::function<void(double)>& progress);

 private:
  struct Stretch {
    std::ptrdiff_t first = 0;
    std::ptrdiff_t last = 0;
    bool done = false;
  };

  void find_stretches();
  std::ptrdiff_t row_of(std::size_t index) const;
  NodeRun run_along(std::ptrdiff_t row, std::ptrdiff_t from, std::ptrdiff_t to) const;
  void cut_from(std::size_t index, Stretch& first);
  bool follow(std::size_t index, const Stretch& last, std::ptrdiff_t& column, Stretch& next);

  ReliefPass& pass_;
  Area area_;
  Wants wants_;
  Height height_;
  Height free_above_;
  std::vector<std::vector<Stretch>> stretches_;  // for each row of work
  std::size_t done_ = 0;
  std::size_t all_ = 0;
};

// Returns the longest gap across which runs are joined: `usual`, but none where the cutter must stay within curves.
inline Mm gap_of(const ReliefProgramOptions& options, Mm usual) {
  return options.area.within.empty() ? usual : Mm(0);
}
// Returns the number of nodes in a distance, at least one.
std::ptrdiff_t nodes_of(Mm distance, Mm pitch);
// Returns the greatest whole number of nodes within a step, at least one.
std::ptrdiff_t step_nodes(Mm step, Mm pitch);
// Returns the stepover of a tool.
Mm step_of(const ReliefTool& tool, const ReliefProgramOptions& options, bool is_roughing);

// Return how far the cutter centres travel beyond the surface. The roughing cutter goes so far that the finishing
// cutter meets no unroughed stock beside the surface.
Mm finishing_overrun(const ReliefProgramOptions& options);
Mm roughing_overrun(const ReliefProgramOptions& options);
Mm rest_overrun(const ReliefProgramOptions& options);

// Returns the tip heights on the surface and on a margin of `overrun` around it. `floor`: the minimum height of the
// tip.
TipMap tips_of(const HeightGrid& surface, const Cutter& cutter, float floor, Mm overrun,
               const ReliefProgramOptions& options);
// Returns the tip heights of the roughing cutter, including the stock to leave, limited to the top of the stock.
TipMap roughing_tips(const HeightGrid& surface, const NodeLattice& lattice, const ReliefProgramOptions& options);
// Returns the nodes where the program may cut: all nodes within the curves, or only those of them that are at most
// `around` away from a node where the cutter touches the model.
NodeMask nodes_of_work(const TipMap& map, const HeightGrid& surface, const NodeLattice& lattice, Mm around, float floor,
                       const ReliefProgramOptions& options);
// Returns those of them where the finishing cutter cuts, or is about to cut: not those where its tip is at the top of
// the stock.
NodeMask nodes_of_finishing(const TipMap& map, const HeightGrid& surface, const NodeLattice& lattice,
                            const ReliefProgramOptions& options);

// Cuts runs that follow each other without a gap, but skips air cuts: where the tip stays at the top of the stock for
// longer than a lift takes, the tool is lifted.
class RunsBelowTop {
 public:
  explicit RunsBelowTop(ReliefPass& pass);
  void cut(const NodeRun& run);

 private:
  void cut_part(const NodeRun& run, std::size_t first, std::size_t last);
  double length_of(const NodeRun& run, std::size_t first, std::size_t last) const;

  ReliefPass& pass_;
  double longest_;            // mm of air that is not worth a lift
  std::vector<NodeRun> air_;  // since the last cut, if it is not worth a lift
  double gone_ = 0;           // mm
  bool is_down_ = false;
};

AreaSweep::Area area_of(const TipMap& map, std::ptrdiff_t step, std::ptrdiff_t gap);

void rough_out(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
               const std::function<void(double)>& progress);
// Does the same by offsets of each level's outline.
void rough_by_offsets(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                      const std::function<void(double)>& progress);
// Finishes in rows or columns, as `way` says; for columns the surface must be transposed.
void finish_rows(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress);
// The same for rows with gaps: on the model, within curves, in one direction only, closer together on slopes.
void finish_rows_in_area(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                         const std::function<void(double)>& progress);
// Finishes in rows at an angle.
void finish_rows_at_angle(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                          const std::function<void(double)>& progress);
void finish_spiral(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                   const std::function<void(double)>& progress);
// Finishes steep areas at constant heights, the remaining area in rows.
void finish_contours(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                     const std::function<void(double)>& progress);
// Cuts along inner edges with the last cutter.
void finish_pencil(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                   const std::function<void(double)>& progress);
void finish_rest(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress);

}  // namespace passo
