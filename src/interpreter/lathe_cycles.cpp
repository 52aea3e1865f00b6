// BlockExecutor: the lathe cycles G70, G71, G72 (.1 .2).
//
// A cycle's block moves to its X and Z. The lines of its sub are then read as a contour instead of being executed
// (interpreter.cpp gives them to add_to_contour), and when the sub has returned the moves are given, a few at a time.
#include <cmath>

#include "arc_center.hpp"
#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;
using Shape = LatheSegment::Shape;

constexpr double highest_sub = 1e9;
constexpr double most_finishing_passes = 1000;
constexpr LetterSet contour_letters = "XZUWIKRAC";

constexpr bool finishes(CodeNumber number) {
  return number == code(70);
}
constexpr bool faces(CodeNumber number) {
  return number >= code(72);
}

}  // namespace

bool BlockExecutor::start_lathe(CodeNumber number) {
  std::int32_t sub = 0;
  if (!check_lathe(number) || !whole_word('Q', 0, highest_sub, sub)) return false;
  Point start;
  if (!end_point(start) || !check_feed()) return false;
  start[Axis::u] = state_.position[Axis::u];  // U and W are allowances here
  start[Axis::w] = state_.position[Axis::w];
  state_.position = start;
  emit(operation::StraightTraverse{start});
  state_.modal.set(motion, code(0));  // the contour's first line may leave it out

  if (lathe_ == nullptr) lathe_ = std::make_unique<LatheCycle>();
  *lathe_ = LatheCycle{};
  lathe_->code = number;
  lathe_->words = words_;
  lathe_->span = words_.span('Q');
  lathe_->text = reporter_.block().text;
  lathe_->source = source_;
  lathe_->sub = symbols_.intern(fmt::format("{}", sub));
  lathe_->start = start;
  lathe_->corner = lathe_point(start);
  cycle_ = Cycle::contour;
  return true;
}

bool BlockExecutor::check_lathe(CodeNumber number) {
  const std::string name = spelling('G', number);
  if (!words_.has('Q')) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without Q", name),
                "Q, the number of the sub with the contour");
  }
  if (state_.modal[plane] != code(18)) {
    return fail("gcode.wrong-plane", motion_span(), fmt::format("{} outside the plane ZX", name), "G18 before");
  }
  if (!check_cycle(name)) return false;
  const auto positive = [&](char letter) {
    return !words_.has(letter) || words_[letter] > 0 ||
           fail("gcode.negative-word", words_.span(letter),
                fmt::format("{} of {} is {}", letter, name, plain_number(words_[letter])),
                fmt::format("{} above 0", letter));
  };
  std::int32_t passes = 1;
  if (words_.has('R') && words_['R'] < 0) return positive('R');
  return positive('I') && (!words_.has('P') || whole_word('P', 1, most_finishing_passes, passes));
}

LathePoint BlockExecutor::lathe_point(const Point& point) const {
  return LathePoint(point[Axis::z], point[Axis::x]) / state_.length_unit();
}

void BlockExecutor::abandon_cycle() {
  cycle_ = Cycle::none;
}

// A line of the contour. What is wrong with it is told; the cycle is not executed then.
void BlockExecutor::add_to_contour(const Block& block) {
  state_.line = block.line;
  if (!words_.read(block, parameters_, reporter_) || (!block.assignments.empty() && !assign(block)) ||
      !add_segment(block)) {
    lathe_->good = false;
  }
}

bool BlockExecutor::add_segment(const Block& block) {
  for (const Word& word : block.words) {
    const bool motion_code = word.letter == 'G' && words_.code(motion) != nullptr;
    if (motion_code || contour_letters.has(word.letter)) continue;
    reporter_.warning("gcode.unused-in-contour", word.span,
                      fmt::format("{} has no effect in the contour of a lathe cycle", reporter_.quote(word.span)),
                      "G0 to G3 with X Z U W, I K or R, A or C");
  }
  if (words_.code(motion) != nullptr) {
    const CodeNumber number = words_.code(motion)->number;
    if (number > code(3)) {
      return fail("gcode.bad-contour", words_.span(motion), "the contour of a lathe cycle is made of lines and arcs",
                  "G0, G1, G2 or G3");
    }
    state_.modal.set(motion, number);
  }
  LatheSegment segment;
  segment.line = block.line;
  segment.start = lathe_->corner;
  if (!contour_point(segment.end)) return false;
  if (segment.end == segment.start) return true;
  const CodeNumber active = state_.modal[motion];
  if (active == code(2) || active == code(3)) {
    segment.shape = active == code(2) ? Shape::clockwise : Shape::counterclockwise;
    if (!contour_arc(segment)) return false;
  }
  std::vector<LatheSegment>& segments = lathe_->contour.segments;
  if (segments.size() + 2 > LatheCycle::most_segments) {
    return fail("gcode.bad-contour", motion_span(),
                fmt::format("the contour has more than {} lines and arcs", LatheCycle::most_segments), "fewer");
  }
  segments.push_back(segment);
  lathe_->corner = segment.end;
  state_.position[Axis::z] = segment.end.real() * state_.length_unit();
  state_.position[Axis::x] = segment.end.imag() * state_.length_unit();
  return add_corner(segment);
}

// X and Z as the cycle's block counts distances; U and W are always increments.
bool BlockExecutor::contour_point(LathePoint& end) {
  const double unit = state_.length_unit();
  const bool incremental = state_.modal.incremental();
  double coordinates[2] = {lathe_->corner.real(), lathe_->corner.imag()};
  for (const auto& [axis, increment, at] : {std::tuple{Axis::z, 'W', 0}, {Axis::x, 'U', 1}}) {
    const char letter = letter_of(axis);
    if (words_.has(increment) && (words_.has(letter) || incremental)) {
      return fail("gcode.bad-contour", words_.span(increment),
                  fmt::format("{} beside {}, or in incremental distances (G91)", increment, letter),
                  fmt::format("{} or {}, in G90", letter, increment));
    }
    if (words_.has(letter)) {
      coordinates[at] = axis_word(axis) / unit + (incremental ? coordinates[at] : 0);
    } else if (words_.has(increment)) {
      coordinates[at] += increment == 'U' && state_.modal.diameters() ? words_['U'] / 2 : words_[increment];
    }
  }
  end = {coordinates[0], coordinates[1]};
  return true;
}

bool BlockExecutor::contour_arc(LatheSegment& segment) {
  const double unit = state_.length_unit();
  const auto in_plane = [unit](LathePoint point) { return PlanePoint{point.real() * unit, point.imag() * unit}; };
  const ArcTolerance& tolerance = state_.modal.inches() ? arc_tolerance_inch : arc_tolerance_mm;
  const bool by_center = words_.has('I') || words_.has('K');
  ArcCenter found;
  if (by_center && words_.has('R')) {
    return fail("gcode.mixed-arc", words_.span('R'), "an arc with a radius and a centre", "R, or I K");
  }
  if (words_.has('R')) {
    found = center_from_radius(in_plane(segment.start), in_plane(segment.end), words_['R'] * unit,
                               segment.shape == Shape::clockwise, tolerance);
  } else if (by_center) {
    const bool absolute = state_.modal[arc_distance] == code(90, 1);
    LathePoint center = absolute ? LathePoint{} : segment.start;
    center += LathePoint(words_.has('K') ? words_['K'] : 0, words_.has('I') ? words_['I'] : 0);
    found = check_center(in_plane(segment.start), in_plane(segment.end), in_plane(center), tolerance);
  } else {
    return fail("gcode.missing-center", motion_span(), "an arc without a centre or a radius",
                "I and K (or one of them) for the centre, or R");
  }
  segment.center = LathePoint(found.center.first, found.center.second) / unit;
  return report_arc(found);
}

// A: the corner behind this line is rounded; C: it is cut off.
bool BlockExecutor::add_corner(const LatheSegment& behind) {
  if (!words_.has('A') && !words_.has('C')) return true;
  if (words_.has('A') && words_.has('C')) {
    return fail("gcode.bad-contour", words_.span('C'), "A and C on one corner", "A rounds it, C cuts it off");
  }
  LatheSegment corner;
  corner.shape = words_.has('A') ? Shape::fillet : Shape::chamfer;
  corner.size = words_[words_.has('A') ? 'A' : 'C'];
  corner.start = corner.end = behind.end;
  corner.line = behind.line;
  if (corner.size != 0) lathe_->contour.segments.push_back(corner);
  return true;
}

// The sub has returned.
void BlockExecutor::end_contour() {
  cycle_ = Cycle::none;
  words_ = lathe_->words;
  source_ = lathe_->source;
  state_.line = lathe_->source.line;
  state_.position = lathe_->start;
  if (!lathe_->good) return;
  if (lathe_->contour.segments.size() < 2) {
    fail_contour("the contour has fewer than two lines and arcs", "a line to where the part begins, and the part");
    return;
  }
  if (!finishes(lathe_->code)) lead_out();
  lathe_->contour.segments.front().start = lathe_point(lathe_->start);
  const LatheFault fault = finishes(lathe_->code) ? plan_finishing() : plan_roughing();
  if (fault != LatheFault::none) {
    report_contour(fault);
    return;
  }
  cycle_ = Cycle::lathe;
}

// A contour that ends inside the stock is led out of it, and that way out is set off as well; but where the contour
// ends along the cuts, it ends there, and the way out (LatheRoughing adds it) is at its very end.
void BlockExecutor::lead_out() {
  std::vector<LatheSegment>& segments = lathe_->contour.segments;
  const LathePoint start = lathe_point(lathe_->start);
  const LathePoint end = lathe_->corner;
  const LathePoint first = segments.front().end - segments.front().start;
  const LathePoint last = segments.back().end - segments.back().start;
  if (last.real() == 0 || last.imag() == 0) return;
  LatheSegment out;
  out.line = segments.back().line;
  out.start = end;
  if (faces(lathe_->code)) {
    if (first.real() * (start.real() - end.real()) >= 0) return;
    out.end = {start.real(), end.imag()};
  } else {
    if (first.imag() * (start.imag() - end.imag()) >= 0) return;
    out.end = {end.real(), start.imag()};
  }
  segments.push_back(out);
}

LatheFault BlockExecutor::plan_roughing() {
  const auto word = [this](char letter, double otherwise) { return words_.has(letter) ? words_[letter] : otherwise; };
  LatheContour& contour = lathe_->contour;
  if (faces(lathe_->code)) contour.turn();
  contour.orient();
  if (const LatheFault fault = contour.work_out_corners(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.check_one_way(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.offset(word('D', 0)); fault != LatheFault::none) return fault;
  for (LatheSegment& segment : contour.segments) segment.move({word('W', 0), word('U', 0)});
  const auto extent = static_cast<LatheRoughing::Extent>(lathe_->code % 10);
  lathe_->roughing.emplace(std::move(contour), extent, word('I', 1), word('R', 0.5));
  return LatheFault::none;
}

// Turning or facing, whichever way the contour goes.
LatheFault BlockExecutor::plan_finishing() {
  const auto word = [this](char letter, double otherwise) { return words_.has(letter) ? words_[letter] : otherwise; };
  LatheContour& contour = lathe_->contour;
  LatheContour part = contour;
  part.segments.erase(part.segments.begin());
  part.orient();
  if (!part.goes_one_way()) contour.turn();
  contour.orient();
  if (const LatheFault fault = contour.work_out_corners(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.check_one_way(); fault != LatheFault::none) return fault;
  const auto passes = static_cast<std::int32_t>(std::round(word('P', 1)));
  lathe_->finishing.emplace(std::move(contour), word('D', 0), word('E', 0), passes);
  return LatheFault::none;
}

bool BlockExecutor::step_lathe() {
  LatheMoves moves;
  const bool more = lathe_->roughing ? lathe_->roughing->step(moves) : lathe_->finishing->step(moves);
  const LatheFault fault = lathe_->roughing ? lathe_->roughing->fault() : lathe_->finishing->fault();
  for (const LatheMove& move : moves) {
    if (!emit_lathe_move(move)) return false;
  }
  if (fault != LatheFault::none) return report_contour(fault);
  if (!more) cycle_ = Cycle::none;
  return true;
}

bool BlockExecutor::emit_lathe_move(const LatheMove& move) {
  using Kind = LatheMove::Kind;
  const LatheOrientation& orientation =
      lathe_->roughing ? lathe_->roughing->orientation() : lathe_->finishing->orientation();
  const double unit = state_.length_unit();
  const LathePoint end = orientation.to_program(move.end) * unit;
  if (!std::isfinite(end.real()) || !std::isfinite(end.imag())) return report_contour(LatheFault::stuck);
  const PlanePoint from{state_.position[Axis::z], state_.position[Axis::x]};
  state_.position[Axis::z] = end.real();
  state_.position[Axis::x] = end.imag();
  if (move.kind == Kind::rapid || move.kind == Kind::line) {
    const bool rapid = move.kind == Kind::rapid;
    state_.modal.set(motion, rapid ? code(0) : code(1));
    rapid ? emit(operation::StraightTraverse{state_.position}) : emit(operation::StraightFeed{state_.position});
    return true;
  }
  const PlanePoint to{end.real(), end.imag()};
  if (std::hypot(to.first - from.first, to.second - from.second) < lathe_tolerance::same * unit) return true;
  const LathePoint center = orientation.to_program(move.center) * unit;
  const ArcCenter arc = check_center(from, to, {center.real(), center.imag()},
                                     state_.modal.inches() ? arc_tolerance_inch : arc_tolerance_mm);
  if (arc.fault != ArcFault::none) return report_contour(LatheFault::vanished);
  const bool clockwise = (move.kind == Kind::clockwise) != orientation.swaps_arcs();
  state_.modal.set(motion, clockwise ? code(2) : code(3));
  emit(operation::ArcFeed{Plane::zx, state_.position, Mm(center.real()), Mm(center.imag()), clockwise ? -1 : 1});
  return true;
}

bool BlockExecutor::report_contour(LatheFault fault) {
  switch (fault) {
    case LatheFault::not_monotonic:
      return fail_contour("the contour turns back along its way", faces(lathe_->code)
                                                                      ? "X that only rises, or only falls"
                                                                      : "Z that only rises, or only falls");
    case LatheFault::corner:
      return fail_contour("a corner of the contour cannot be rounded or cut off", "a smaller A or C");
    case LatheFault::parallel:
    case LatheFault::vanished:
      return fail_contour("the distance D leaves nothing of a part of the contour", "a smaller D, or wider arcs");
    default: return fail_contour("the contour cannot be cut in this way", "a contour without undercuts");
  }
}

// The contour's lines are behind us: the cycle's own line is quoted.
bool BlockExecutor::fail_contour(std::string message, std::string expected) {
  reporter_.error_at("gcode.bad-contour", lathe_->source.line, lathe_->text, lathe_->span, std::move(message),
                     std::move(expected));
  return false;
}

}  // namespace passo
