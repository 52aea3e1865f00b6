// HeldRemoval: feeds by engagement: what a cutter takes off a minute is held. Private to carve/.
//
// Each move in work is cut out of the stock in pieces of half the cutter's radius, before it is written. What a piece
// takes off tells the feed at which it takes off what is asked. Very short pieces are measured together, so that a cell
// of the stock more or less does not count. Pieces of a move with one feed are written as one.
#pragma once

#include <cstdint>
#include <deque>

#include "move_writer.hpp"
#include "stock_in_work.hpp"

namespace passo {

struct HeldFeed {
  double mm3_a_minute = 0;  // 0: nothing is held
  double slowest = 0.1;     // shares of the usual feed
  double fastest = 1;
};

class HeldRemoval {
 public:
  explicit HeldRemoval(MoveWriter& writer) : writer_(writer) {}

  // `stock` outlives this; told() is its watcher.
  void set_stock(StockInWork* stock) { stock_ = stock; }
  void set(const HeldFeed& feed, Mm radius);
  void add(const CarvedCut& cut);
  void told(std::uint32_t number, double mm3);
  void settle();
  // The most that a piece takes off a minute, at its feed, since the last call.
  double take_most();

 private:
  struct Piece {
    CarvedCut cut;
    double way = 0;
    double mm3 = 0;
    double share = 1;        // of the usual feed
    bool ends_move = false;  // a piece of another move follows
  };

  void judge(std::size_t first, std::size_t end, double way, double mm3);
  void write_judged();

  MoveWriter& writer_;
  StockInWork* stock_ = nullptr;
  HeldFeed feed_;
  double radius_ = 1;
  std::deque<Piece> pieces_;
  std::uint32_t first_number_ = 0;  // of the first of them
  std::size_t told_ = 0;
  std::size_t judged_ = 0;
  double most_ = 0;
};

}  // namespace passo
