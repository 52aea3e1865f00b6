#include "lathe_cycle.hpp"

#include <cmath>

namespace passo {
namespace {

PlanePoint in_plane(const Point& point) {
  return {point[Axis::z], point[Axis::x]};
}

}  // namespace

bool LatheCycle::step() {
  return std::visit(
      [this](auto& cuts) {
        LatheMoves moves;
        const bool more = cuts.step(moves);
        for (const LatheMove& move : moves) {
          fault_ = add(move, cuts.orientation());
          if (fault_ != LatheFault::none) return false;
        }
        fault_ = cuts.fault();
        return more;
      },
      plan_.cuts);
}

LatheFault LatheCycle::add(const LatheMove& move, const LatheOrientation& orientation) {
  const LathePoint to = orientation.to_program(move.end) * plan_.unit;
  if (!std::isfinite(to.real()) || !std::isfinite(to.imag())) return LatheFault::stuck;
  Point end = position_;
  end[Axis::z] = to.real();
  end[Axis::x] = to.imag();
  if (move.kind != LatheMove::Kind::rapid && move.kind != LatheMove::Kind::line) {
    return add_arc(move, orientation, end);
  }
  const bool rapid = move.kind == LatheMove::Kind::rapid;
  last_motion_ = rapid ? code(0) : code(1);
  rapid ? traverse(end) : feed(end);
  return LatheFault::none;
}

LatheFault LatheCycle::add_arc(const LatheMove& move, const LatheOrientation& orientation, const Point& end) {
  const PlanePoint from = in_plane(position_);
  const PlanePoint to = in_plane(end);
  position_ = end;
  const double chord = std::hypot(to.first - from.first, to.second - from.second);
  if (chord < lathe_tolerance::same * plan_.unit) return LatheFault::none;
  const LathePoint center = orientation.to_program(move.center) * plan_.unit;
  const ArcCenter arc = check_center(from, to, {center.real(), center.imag()}, plan_.tolerance);
  if (arc.fault != ArcFault::none) return LatheFault::vanished;
  const bool clockwise = (move.kind == LatheMove::Kind::clockwise) != orientation.swaps_arcs();
  last_motion_ = clockwise ? code(2) : code(3);
  emit(operation::ArcFeed{Plane::zx, end, Mm(center.real()), Mm(center.imag()), clockwise ? -1 : 1});
  return LatheFault::none;
}

}  // namespace passo
