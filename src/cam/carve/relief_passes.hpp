// What the parts of a relief's program share: the writer, the lattice, and how a cutter gets to its work.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "level_lines.hpp"
#include "level_path.hpp"
#include "move_writer.hpp"
#include "node_run.hpp"
#include "parallel_rows.hpp"
#include "stock_in_work.hpp"

#include "passo/carve/dropped_cutter.hpp"
#include "passo/carve/relief_program.hpp"

namespace passo {

// Where the tip was, at nodes; elsewhere it was not. For the view of what is carved.
class TipRecord {
 public:
  TipRecord(const HeightGrid& surface, std::size_t margin_x, std::size_t margin_y);

  void add(const NodeLattice& lattice, const NodeRun& run);
  // Ways between nodes count at the nearest node, at which the tip is no lower than it may be there.
  void add(const std::vector<CarvedCut>& way, const NodeLattice& lattice, const TipSurface& surface);
  // Lowers `carved` to what the cutter has left.
  void carve(const Cutter& cutter, unsigned threads, CarvedSurface& carved) const;

 private:
  std::ptrdiff_t margin_x_;
  std::ptrdiff_t margin_y_;
  HeightGrid depths_;  // of the tips below zero
};

class ReliefPass {
 public:
  ReliefPass(MoveWriter& writer, const ReliefProgramOptions& options) : writer_(writer), options_(options) {}

  MoveWriter& writer() { return writer_; }
  const ReliefProgramOptions& options() const { return options_; }

  void set_lattice(const NodeLattice& lattice) { lattice_ = lattice; }
  void set_record(TipRecord* record) { record_ = record; }
  // The stock that the writer's moves cut, for what asks for it. None: nobody knows it.
  void set_stock(StockInWork* stock) { stock_ = stock; }
  StockInWork* stock() const { return stock_; }

  // Lifts the tool, goes to the run's first node, and enters the stock there. From `free_above` upwards there is no
  // stock.
  void go_to_work(const NodeRun& run, double free_above);
  // Cuts along the run, whose first node the tool is at.
  void cut(const NodeRun& run);
  void lift();

  // Where the tool is, in mm from node (0, 0).
  FlatPlace flat_place() const { return flat(writer_.place()); }

  // How the tool may get to a way.
  struct WayEntry {
    double near = 0;        // mm; a way that begins so near is gone to without lifting, where nothing stands between
    bool sideways = false;  // at its depth, into the stock beside: what stands there is as wide as a row at most
    bool is_for_stock = false;  // where no stock stands above the way, it is left out
  };
  // Gets to a way of lines and arcs, goes down along it, and cuts along all of it. Needs the stock.
  void cut_way(const LevelPath& path, const TipSurface& surface, const WayEntry& entry);

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
  bool is_at_work_ = false;  // this cutter, at a known place
};

// Rows of runs at one depth, in the order in which one can follow the other without lifting.
//
// wants(column, row): the cutter has work there. height(column, row): the tip's height there, free of gouges.
// free_above(column, row): no stock stands above, where the cutter has work.
class AreaSweep {
 public:
  struct Area {
    std::ptrdiff_t first_column = 0;
    std::ptrdiff_t end_column = 0;
    std::ptrdiff_t first_row = 0;
    std::ptrdiff_t end_row = 0;
    std::ptrdiff_t step = 1;  // between rows of work
    std::ptrdiff_t gap = 0;   // runs that are no farther apart become one
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
  std::vector<std::vector<Stretch>> stretches_;  // of each row of work
  std::size_t done_ = 0;
  std::size_t all_ = 0;
};

// How many nodes a distance takes, at least one.
std::ptrdiff_t nodes_of(Mm distance, Mm pitch);
// The greatest whole number of nodes within a step, at least one.
std::ptrdiff_t step_nodes(Mm step, Mm pitch);
// The distance between rows that a tool is to keep.
Mm step_of(const ReliefTool& tool, const ReliefProgramOptions& options, bool is_roughing);

// How far the cutters' middles go beyond the surface. The roughing cutter goes so far that the finishing cutter finds
// no stock beside the surface that nobody has roughed.
Mm finishing_overrun(const ReliefProgramOptions& options);
Mm roughing_overrun(const ReliefProgramOptions& options);
Mm rest_overrun(const ReliefProgramOptions& options);

// The tip's heights on the surface and `overrun` around it. The tip goes nowhere below `floor`.
TipMap tips_of(const HeightGrid& surface, const Cutter& cutter, float floor, Mm overrun,
               const ReliefProgramOptions& options);
// Of roughing: that of the cutter with the stock that it leaves, no higher than the stock's top.
TipMap roughing_tips(const HeightGrid& surface, const ReliefProgramOptions& options);
AreaSweep::Area area_of(const TipMap& map, std::ptrdiff_t step, std::ptrdiff_t gap);

void rough_out(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
               const std::function<void(double)>& progress);
// The same by offsets of each level's outline.
void rough_by_offsets(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                      const std::function<void(double)>& progress);
// `way` is rows or columns; for columns the surface is turned.
void finish_rows(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress);
void finish_spiral(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                   const std::function<void(double)>& progress);
// Constant heights on what is steep, rows on the rest.
void finish_contours(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                     const std::function<void(double)>& progress);
void finish_rest(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress);

}  // namespace passo
