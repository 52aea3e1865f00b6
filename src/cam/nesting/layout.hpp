// One layout: the items of a sequence, each at the place that a rule prefers. Private to nesting/.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "no_fit.hpp"

#include "passo/nesting/nesting.hpp"

namespace passo::nesting {

// A shape as turned by each rotation.
struct TurnedShape {
  double degrees = 0;
  Polygons grown = {};  // by half of the gap
  Extent extent = {};   // of the shape itself
  bool fits = false;    // the sheet
  Extent places = {};   // of its position, so that it lies on the sheet
  Polygons free = {};   // of an empty sheet
};

struct ShapeToNest {
  std::vector<TurnedShape> turns = {};
  double area_mm2 = 0;
};

constexpr std::uint8_t any_turn = 255;
struct LayoutItem {
  std::uint32_t shape = 0;
  std::uint8_t turn = any_turn;  // otherwise an index of TurnedShape
};

// What decides between places: the right edge, then the height; the left edge, then the height; the box around all; the
// distance to the lower left corner, along X and Y. The first three put round parts into the gaps between others, the
// last one puts them into rows and columns.
enum class PlaceRule : std::uint8_t { right, left, box, corner };

struct LaidCopy {
  std::uint32_t shape = 0;
  std::uint8_t turn = 0;
  Spot at{};
};

struct Layout {
  std::vector<std::vector<LaidCopy>> sheets = {};
  ClipperLib::cInt length = 0;  // used on the last sheet, steps
  ClipperLib::cInt height = 0;  // on the last sheet
  double work = 0;              // corners that Clipper was given

  bool is_better_than(const Layout& other) const;
};

// Lays out sequences. Keeps the no-fit polygons of all pairs.
class LayoutMaker {
 public:
  LayoutMaker(std::vector<ShapeToNest> shapes, std::uint32_t rotations)
      : shapes_(std::move(shapes)), rotations_(rotations) {}

  // Every item fits on an empty sheet, as turned by its turn if it has one.
  Layout lay(const std::vector<LayoutItem>& sequence, PlaceRule rule);

  const std::vector<ShapeToNest>& shapes() const { return shapes_; }

 private:
  struct FreePlaces {
    Polygons polygons = {};
    std::size_t applied = 0;  // number of copies on the sheet that it has left out
    bool is_begun = false;
  };
  struct Place {
    std::array<ClipperLib::cInt, 4> score = {};
    LaidCopy copy = {};
  };

  const Polygons& no_fit(const LaidCopy& resting, std::uint32_t shape, std::uint8_t turn);
  const Polygons& free_places(std::uint32_t shape, std::uint8_t turn);
  void consider(std::uint32_t shape, std::uint8_t turn, PlaceRule rule, Place& best, bool& is_found);
  void begin_sheet();
  void put(const LaidCopy& copy);

  std::vector<ShapeToNest> shapes_;
  std::uint32_t rotations_;
  std::map<std::array<std::uint32_t, 4>, Polygons> no_fits_;
  // Of the sheet in work.
  std::vector<LaidCopy> sheet_;
  std::vector<std::vector<FreePlaces>> free_;
  Spot used_{};
  double work_ = 0;
};

}  // namespace passo::nesting
