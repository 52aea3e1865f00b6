#include "run_reader.hpp"

#include <algorithm>
#include <limits>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// A turn with a smaller cosine than this goes back: it is sharper than about 179 degrees.
constexpr double turning_back = -0.9998;

// In exact path mode, turns up to exact_turn (radians) are smoothed within exact_tolerance (mm).
constexpr double exact_turn = 0.01;
constexpr double tolerance_of_exact_path = 0.001;

// In exact path mode: what rounding may take. Less where the segment stands for a part of a curve, and leaves it.
double exact_tolerance_of(const Segment& segment) {
  const double given = segment.tolerance.value();
  return given > 0 ? std::min(given, tolerance_of_exact_path) : tolerance_of_exact_path;
}

Point unit_vector(const Point& vector) {
  return vector * (1 / length_of(vector));
}

}  // namespace

bool RunReader::pull() {
  if (!has_ahead_ && !at_end_) {
    has_ahead_ = fitter_.next(ahead_, ahead_deviation_);
    at_end_ = !has_ahead_;
  }
  return has_ahead_;
}

RunReader::Next RunReader::peek() {
  if (!pull()) return Next::end;
  return std::holds_alternative<Action>(ahead_) ? Next::action : Next::run;
}

Action RunReader::take_action() {
  has_ahead_ = false;
  return std::get<Action>(ahead_);
}

std::uint64_t RunReader::begin() {
  junction_tolerance_ = 0;
  read_piece();
  return pieces_.end() - 1;
}

bool RunReader::has(std::uint64_t number) {
  while (number >= pieces_.end()) {
    if (pieces_.back().rest_after) return false;
    read_piece();
  }
  return true;
}

void RunReader::read_piece() {
  const bool begins = junction_tolerance_ == 0;
  const double start = begins ? 0 : pieces_.back().end();
  Piece& piece = pieces_.append();
  piece.segment = std::get<Segment>(ahead_);
  const double deviation = ahead_deviation_;
  piece.is_fitted = piece.segment.curve.shape() == Curve::Shape::cubic && deviation > 0;
  has_ahead_ = false;

  const Curve& curve = piece.segment.curve;
  piece.start = start;
  piece.length = curve.length().value();
  piece.first_tangent = curve.tangent(Mm(0));
  piece.first_bend = curve.second_derivative(Mm(0));
  const bool straight = curve.shape() == Curve::Shape::line;
  piece.last_tangent = straight ? piece.first_tangent : curve.tangent(curve.length());
  piece.last_bend = straight ? piece.first_bend : curve.second_derivative(curve.length());

  constexpr double unlimited = std::numeric_limits<double>::max();
  double tube = begins ? unlimited : junction_tolerance_;
  const auto* const after = pull() ? std::get_if<Segment>(&ahead_) : nullptr;
  junction_tolerance_ = after != nullptr ? tolerance_between(piece, *after) : 0;
  piece.rest_after = junction_tolerance_ == 0;
  if (!piece.rest_after) tube = std::min(tube, junction_tolerance_);
  if (piece.segment.mode == PathMode::exact_path) tube = std::min(tube, exact_tolerance_of(piece.segment));
  piece.tube = tube - deviation;
}

double RunReader::tolerance_between(const Piece& before, const Segment& after) const {
  if (before.segment.mode == PathMode::exact_stop) return 0;
  const Point in = unit_vector(before.last_tangent);
  const Point out = unit_vector(after.curve.tangent(Mm(0)));
  if (dot(in, out) < turning_back) return 0;
  if (before.segment.mode != PathMode::exact_path) return before.segment.tolerance.value();
  return distance(in, out) <= exact_turn ? exact_tolerance_of(before.segment) : 0;
}

}  // namespace passo
