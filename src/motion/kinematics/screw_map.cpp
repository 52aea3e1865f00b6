#include "passo/kinematics/screw_map.hpp"

#include <limits>

namespace passo {

ScrewMap::ScrewMap(double backlash, std::vector<Error> errors) : backlash_(backlash) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (errors.empty()) errors.push_back({});
  const auto true_place = [](const Error& error) { return error.at + error.off; };
  pieces_.push_back({.low = -infinity, .high = true_place(errors.front()), .offset = -errors.front().off});
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const Error& low = errors[i - 1];
    const Error& high = errors[i];
    const double slope = (high.at - low.at) / (true_place(high) - true_place(low));
    pieces_.push_back(
        {.low = true_place(low), .high = true_place(high), .slope = slope, .offset = low.at - slope * true_place(low)});
  }
  pieces_.push_back({.low = true_place(errors.back()), .high = infinity, .offset = -errors.back().off});
}

const ScrewMap::Piece& ScrewMap::piece_at(double place, bool above, double border) const {
  const double inside = above ? place + border : place - border;
  for (const Piece& piece : pieces_) {
    if (inside < piece.high) return piece;
  }
  return pieces_.back();
}

double ScrewMap::nominal(double place, bool down) const {
  const Piece& piece = piece_at(place, true, 0);
  return piece.offset + piece.slope * place - (down ? backlash_ : 0);
}

double ScrewMap::place(double nominal, bool down) const {
  const double up = down ? nominal + backlash_ : nominal;
  for (const Piece& piece : pieces_) {
    if (up < piece.offset + piece.slope * piece.high) return (up - piece.offset) / piece.slope;
  }
  return up - pieces_.back().offset;
}

}  // namespace passo
