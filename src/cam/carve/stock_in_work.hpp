// StockInWork: the stock as cut by the program so far, for code that needs the remaining material. Private to carve/.
//
// It covers the whole range of the cutters, including the area beside the surface; its top is Z 0. Cells are some
// tenths of the smallest cutter's radius, and have the height at their centres. A sliver may remain between two
// centres. So a second field of coarser cells has an upper bound for each cell: thinner tools cut it (`thinned`, in
// passo/stock/cut_target.hpp). Rapids rely on the bound, ramps on the heights.
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

  double radius() const { return shapes_[tool_].radius.value(); }  // of the selected cutter, mm
  // Returns a tip height to which a rapid may go down at a position. The cutter touches no stock there.
  double rapid_height(const FlatPlace& place);
  // Returns the lowest tip height at which the cutter touches no stock, within `around` mm of a position.
  double free_height(const FlatPlace& place, double around);
  // Returns the same for a whole toolpath.
  double free_height(const std::vector<CarvedCut>& way);
  // Returns the lowest tip height at which the inner half of the cutter touches no stock at a position, and along a
  // toolpath.
  double free_height_inside(const FlatPlace& place);
  double free_height_inside(const std::vector<CarvedCut>& way);

 private:
  // A field, and the height of the cutter above its tip for each cell around the cutter's own cell (one quadrant).
  struct Layer {
    HeightField field;
    std::unique_ptr<StockCutter> cutter = nullptr;
    std::vector<float> heights = {};
    std::ptrdiff_t reach = 0;
    // The cutter for which the heights were computed.
    double around = -1;
    double inside = 0;
    std::size_t tool = 0;
  };
  void measure(Layer& layer, double around, double inside) const;
  double highest(Layer& layer, const FlatPlace& place, double around, double inside);

  Layer heights_;
  Layer bound_;
  double x0_;
  double y0_;
  std::vector<Cutter> shapes_;
  std::vector<Mm> raised_;  // for each shape: how much higher the tip of its thinner tool is
  std::size_t tool_ = 0;
  bool is_settled_ = true;
};

}  // namespace passo
