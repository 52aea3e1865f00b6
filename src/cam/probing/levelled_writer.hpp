// LevelledWriter: writes moves with the height map applied. It holds back vertical moves, and everything between them,
// until it can decide whether they are a hole, which keeps its depth. Private to probing/.
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "plain_code.hpp"

#include "passo/levelling/height_map.hpp"
#include "passo/levelling/levelled_move.hpp"
#include "passo/probing/levelled_program.hpp"

namespace passo {

inline constexpr double full_turn = 2 * std::numbers::pi;

// A move as programmed, in work coordinates.
struct LevelledMove {
  Point from;
  Point to;
  AxisSet named = {};         // axes that the program specifies
  AxisSet absolute = {};      // those of them that are specified by an absolute position
  bool is_new_place = false;  // the work coordinate of one of them was unknown before
  bool rapid = false;
  bool levelled = true;
  bool from_anywhere = false;  // the start position in X or Y is unknown
  bool from_above = false;     // the start position in Z is unknown
  bool is_arc = false;         // about a centre in X and Y
  double center_x = 0;
  double center_y = 0;
  double sweep = 0;
  double feed = 0;  // mm/min

  bool is_upright() const;
};

// Returns whether two coordinates are equal except for rounding, which a change of the frame introduces.
bool is_same_place(double a, double b);
bool is_same_place(const Point& a, const Point& b);

class LevelledWriter {
 public:
  // The references must outlive the writer. `start`: Z at the start of the levelled program.
  LevelledWriter(const HeightMap& map, const LevelOptions& wish, double start,
                 const std::function<void(std::string_view)>& write)
      : map_(map), highest_(map.highest()), wish_(wish), code_(write), height_(start) {}

  void add(const LevelledMove& move) { add({.line = {}, .move = move, .is_move = true}); }
  void add_line(std::string line) { add({.line = std::move(line), .move = {}}); }
  // Writes the pending moves. `rises`: the sequence ends with a retract in machine coordinates.
  void end_run(bool rises = false);
  // The output for code between the moves, after end_run().
  PlainCode& code() { return code_; }

  // Z of the levelled program, and its difference from the Z of the original program.
  double height() const { return height_; }
  double higher_than(const Point& place) const { return height_ - place[Axis::z]; }
  void set_height(double height) { height_ = height; }
  void rise(double way) { height_ += way; }
  // Sets the current position of the original program, in the current frame.
  void stand_at(const Point& place) { code_.stand_at(at_height(place)); }
  Point at_height(Point place) const {
    place[Axis::z] = height_;
    return place;
  }

  // Returns the maximum height of the surface.
  double highest() const { return highest_; }
  // Whether a move on the surface was added.
  bool any_levelled() const { return any_levelled_; }
  LevelCount& count() { return count_; }
  const LevelCount& count() const { return count_; }

 private:
  // A move, or a line between moves, which is copied.
  struct Item {
    std::string line;
    LevelledMove move;
    bool is_move = false;
  };

  void add(Item item);
  void emit(const Item& item);
  void emit_move(const LevelledMove& move);
  void begin_at_height(const LevelledMove& move);
  void emit_arc_piece(const LevelledMove& move, double from_part, const LevelledPiece& piece);

  const HeightMap& map_;
  const double highest_;
  const LevelOptions& wish_;
  PlainCode code_;
  double height_;
  std::vector<Item> run_;
  bool any_levelled_ = false;
  LevelCount count_;
};

}  // namespace passo
