// StockInWork: the stock as the program has cut it so far, for what must know what still stands. Private to carve/.
//
// It lies under the whole way of the cutters, beside the surface too, and its top is Z 0. Cells are some tenths of the
// smallest cutter's radius; questions about it are answered for the worst that a cell may hide.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "level_lines.hpp"
#include "move_writer.hpp"

#include "passo/carve/relief_program.hpp"
#include "passo/stock/stock_cutter.hpp"

namespace passo {

class StockInWork {
 public:
  // What a move took off, in the order of the moves; some later than the call of cut().
  using Watcher = std::function<void(std::uint32_t number, double mm3)>;

  // `beyond`: how far the cutters' middles go beyond the surface, at most.
  StockInWork(const HeightGrid& surface, const ReliefProgramOptions& options, Mm beyond, Watcher watcher = {});

  // The cutter that cuts from here on, one of the options'.
  void use(const Cutter& cutter);
  void cut(const CarvedCut& cut, std::uint32_t number = 0);
  // All moves are cut, and told.
  void settle();

  // The least height of the tip at which the cutter touches no stock, at a place and up to `around` mm from it.
  double free_height(const FlatPlace& place, double around);
  // The same all along a way.
  double free_height(const std::vector<CarvedCut>& way);

 private:
  void measure(double around);

  HeightField field_;
  std::unique_ptr<StockCutter> cutter_;
  double x0_;
  double y0_;
  std::vector<Cutter> shapes_;
  std::size_t tool_ = 0;
  bool is_settled_ = true;
  // The cutter's height above its tip for each cell around its own, a quarter; and what it was measured for.
  std::vector<float> heights_;
  std::ptrdiff_t reach_ = 0;
  double measured_around_ = -1;
  std::size_t measured_tool_ = 0;
};

}  // namespace passo
