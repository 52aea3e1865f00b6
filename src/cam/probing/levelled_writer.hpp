// LevelledWriter: writes moves at the height of the surface. Moves straight up and down, and what is between them, wait
// until it is known whether they are a hole, whose depth stays. Private to probing/.
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

// A move as the program means it, in work coordinates.
struct LevelledMove {
  Point from;
  Point to;
  AxisSet named = {};         // axes that the program names
  AxisSet absolute = {};      // of these, those that it names by a place
  bool is_new_place = false;  // the work coordinates of one of them were not known before
  bool rapid = false;
  bool levelled = true;
  bool from_anywhere = false;  // nobody knows where it begins in X or Y
  bool from_above = false;     // nobody knows where it begins in Z
  bool is_arc = false;         // about a centre in X and Y
  double center_x = 0;
  double center_y = 0;
  double sweep = 0;
  double feed = 0;  // mm/min

  bool is_upright() const;
};

// After a change of the frame places differ by what their conversion has rounded.
bool is_same_place(double a, double b);
bool is_same_place(const Point& a, const Point& b);

class LevelledWriter {
 public:
  // Everything outlives the writer. `start`: Z where the levelled program begins.
  LevelledWriter(const HeightMap& map, const LevelOptions& wish, double start,
                 const std::function<void(std::string_view)>& write)
      : map_(map), highest_(map.highest()), wish_(wish), code_(write), height_(start) {}

  void add(const LevelledMove& move) { add({.line = {}, .move = move, .is_move = true}); }
  void add_line(std::string line) { add({.line = std::move(line), .move = {}}); }
  // What waits is written. `rises`: a machine's retract ends the run.
  void end_run(bool rises = false);
  // What is written between the moves, after end_run().
  PlainCode& code() { return code_; }

  // Z where the levelled program is, and how much higher that is than where the program is.
  double height() const { return height_; }
  double higher_than(const Point& place) const { return height_ - place[Axis::z]; }
  void set_height(double height) { height_ = height; }
  void rise(double way) { height_ += way; }
  // `place` of the program, which stands there in the frame in force.
  void stand_at(const Point& place) { code_.stand_at(at_height(place)); }
  Point at_height(Point place) const {
    place[Axis::z] = height_;
    return place;
  }

  // The highest place of the surface.
  double highest() const { return highest_; }
  // A move on the surface was added.
  bool any_levelled() const { return any_levelled_; }
  LevelCount& count() { return count_; }
  const LevelCount& count() const { return count_; }

 private:
  // What comes between moves: a line as it is. Or a move.
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
