#include "removal_rate_control.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace passo {

void RemovalRateControl::set(const HeldFeed& feed, Mm radius) {
  settle();
  feed_ = feed;
  radius_ = radius.value();
}

void RemovalRateControl::add(const CarvedCut& cut) {
  if (feed_.mm3_a_minute <= 0) {
    stock_->cut(cut, first_number_ - 1);  // nobody asks for what it takes off
    writer_.write(cut, writer_.feed_of(cut));
    return;
  }
  const double way = length_of(cut);
  const double parts = std::max(1.0, std::ceil(way / (radius_ / 2)));
  CarvedCut piece = cut;
  for (double i = 1; i <= parts; ++i) {
    piece.to = i < parts ? place_on(cut, i / parts) : cut.to;
    const auto number = static_cast<std::uint32_t>(first_number_ + pieces_.size());
    pieces_.push_back({.cut = piece, .way = way / parts, .ends_move = i == parts});
    stock_->cut(piece, number);
    piece.from = piece.to;
  }
  write_judged();
}

void RemovalRateControl::told(std::uint32_t number, double mm3) {
  const std::uint32_t index = number - first_number_;
  if (index >= pieces_.size()) return;
  pieces_[index].mm3 = mm3;
  told_ = index + 1;
}

void RemovalRateControl::judge(std::size_t first, std::size_t end, double way, double mm3) {
  const double feed = writer_.feeds().along.value();
  const double full = way > 0 ? mm3 / way * feed : 0;  // a minute, at the usual feed
  constexpr double part = 20;
  double share = full > 0 ? feed_.mm3_a_minute / full : feed_.fastest;
  share = std::clamp(std::floor(share * part) / part, feed_.slowest, feed_.fastest);
  for (std::size_t i = first; i < end; ++i) {
    pieces_[i].share = share;
    const double at = static_cast<double>(writer_.feed_of(pieces_[i].cut, share)) / carved_units;
    if (way > 0) most_ = std::max(most_, mm3 / way * at);
  }
}

void RemovalRateControl::write_judged() {
  const double least = radius_ / 4;
  double way = 0;
  double mm3 = 0;
  std::size_t first = judged_;
  for (std::size_t i = judged_; i < told_; ++i) {
    way += pieces_[i].way;
    mm3 += pieces_[i].mm3;
    if (way < least && i + 1 < pieces_.size()) continue;
    judge(first, i + 1, way, mm3);
    first = i + 1;
    way = mm3 = 0;
  }
  judged_ = first;
  // Pieces of one move and one feed are one; a move's last piece must be judged too.
  std::size_t begin = 0;
  std::size_t end = 0;
  std::optional<std::int64_t> feed;
  CarvedCut cut;
  for (std::size_t i = 0; i < judged_; ++i) {
    const std::int64_t own = writer_.feed_of(pieces_[i].cut, pieces_[i].share);
    if (feed && (own != *feed || pieces_[i - 1].ends_move)) {
      writer_.write(cut, *feed);
      begin = i;
      feed.reset();
    }
    if (!feed) {
      cut = pieces_[i].cut;
      feed = own;
    }
    cut.to = pieces_[i].cut.to;
    end = i + 1;
  }
  if (feed && (pieces_[end - 1].ends_move || end == pieces_.size())) {
    writer_.write(cut, *feed);
    begin = end;
  }
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(begin));
  first_number_ += static_cast<std::uint32_t>(begin);
  told_ -= begin;
  judged_ -= begin;
}

void RemovalRateControl::settle() {
  if (pieces_.empty()) return;
  stock_->settle();
  told_ = pieces_.size();
  write_judged();
}

double RemovalRateControl::take_most() {
  settle();
  return std::exchange(most_, 0);
}

}  // namespace passo
