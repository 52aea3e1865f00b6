// RemovalRateControl: adapts the feed to the engagement, so that the material removal rate stays constant. Private to
// carve/.
//
// Each cutting move is first cut out of the stock model in pieces of half the cutter's radius, and then written. The
// volume that a piece removes determines the feed that gives the target removal rate. Very short pieces are measured
// together, so that a single cell of the stock has no influence. Consecutive pieces of a move with equal feed are
// written as one.
#pragma once

#include <cstdint>
#include <deque>

#include "move_writer.hpp"
#include "stock_in_work.hpp"

namespace passo {

struct HeldFeed {
  double mm3_a_minute = 0;  // target removal rate, mm³/min; 0: constant feed
  double slowest = 0.1;     // minimum, as a fraction of the usual feed
  double fastest = 1;
};

class RemovalRateControl {
 public:
  explicit RemovalRateControl(MoveWriter& writer) : writer_(writer) {}

  // `stock` must outlive this object, and its watcher must call told().
  void set_stock(StockInWork* stock) { stock_ = stock; }
  void set(const HeldFeed& feed, Mm radius);
  void add(const CarvedCut& cut);
  void told(std::uint32_t number, double mm3);
  void settle();
  // Returns the maximum removal rate of a piece, at its feed, since the last call.
  double take_most();

 private:
  struct Piece {
    CarvedCut cut;
    double way = 0;
    double mm3 = 0;
    double share = 1;        // fraction of the usual feed
    bool ends_move = false;  // the next piece belongs to another move
  };

  void judge(std::size_t first, std::size_t end, double way, double mm3);
  void write_judged();

  MoveWriter& writer_;
  StockInWork* stock_ = nullptr;
  HeldFeed feed_;
  double radius_ = 1;
  std::deque<Piece> pieces_;
  std::uint32_t first_number_ = 0;  // number of the first one of the waiting pieces
  std::size_t told_ = 0;
  std::size_t judged_ = 0;
  double most_ = 0;
};

}  // namespace passo
