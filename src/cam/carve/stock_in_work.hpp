// StockInWork: the stock as cut by the program so far, for code that needs the remaining material. Private to carve/.
//
// It covers the whole range of the cutters, including the area beside the surface; its top is Z 0. Cells are some
// tenths of the smallest cutter's radius; queries return the worst case within a cell.
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
  // Receives the volume removed by each move, in order; possibly after the call of cut().
  using Watcher = std::function<void(std::uint32_t number, double mm3)>;

  // `beyond`: maximum distance of the cutter centres beyond the surface.
  StockInWork(const HeightGrid& surface, const ReliefProgramOptions& options, Mm beyond, Watcher watcher = {});

  // Selects the cutter for the following moves; it must be one of the options' cutters.
  void use(const Cutter& cutter);
  void cut(const CarvedCut& cut, std::uint32_t number = 0);
  // Cuts and reports all pending moves.
  void settle();

  // Returns the lowest tip height at which the cutter touches no stock, within `around` mm of a position.
  double free_height(const FlatPlace& place, double around);
  // Returns the same for a whole toolpath.
  double free_height(const std::vector<CarvedCut>& way);
  // Returns the lowest tip height at which the inner half of the cutter touches no stock along a toolpath.
  double free_height_inside(const std::vector<CarvedCut>& way);

 private:
  void measure(double around, double inside);
  double highest(const FlatPlace& place, double around, double inside);

  HeightField field_;
  std::unique_ptr<StockCutter> cutter_;
  double x0_;
  double y0_;
  std::vector<Cutter> shapes_;
  std::size_t tool_ = 0;
  bool is_settled_ = true;
  // A quadrant with the cutter's height above its tip for each cell around its own; and the parameters for which it was
  // computed.
  std::vector<float> heights_;
  std::ptrdiff_t reach_ = 0;
  double measured_around_ = -1;
  double measured_inside_ = 0;
  std::size_t measured_tool_ = 0;
};

}  // namespace passo
