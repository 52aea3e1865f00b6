#include "lathe_codes.hpp"

#include <cmath>

#include "interpreter_sentences.hpp"
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

bool LatheCodes::start(CodeNumber number) {
  std::int32_t sub = 0;
  if (!check(number) || !whole_word('Q', 0, highest_sub, sub)) return false;
  Point start;
  if (!end_point(start) || !check_feed()) return false;
  start[Axis::u] = state_.position[Axis::u];  // here U and W are allowances, not axis words
  start[Axis::w] = state_.position[Axis::w];
  if (cutter_.active()) {
    const ContourMove lead{true, state_.position, start, kept_operation()};
    if (!cutter_codes_.report(cutter_.line(lead), motion_span())) return false;
  } else {
    emit(operation::StraightTraverse{start});
  }
  state_.position = start;
  state_.modal.set(motion, code(0));  // for a contour whose first line has no motion code

  if (contour_ == nullptr) contour_ = std::make_unique<Contour>();
  *contour_ = Contour{};
  contour_->code = number;
  contour_->words = words_;
  contour_->span = words_.span('Q');
  contour_->text = reporter_.block().text;
  contour_->block = reporter_.block();
  contour_->block.text = contour_->text;
  contour_->source = block_.source;
  contour_->errors_before = reporter_.errors();
  contour_->sub = symbols_.intern(fmt::format("{}", sub));
  contour_->start = start;
  contour_->corner = lathe_point(start);
  return true;
}

bool LatheCodes::check(CodeNumber number) {
  const std::string name = spelling('G', number);
  if (!words_.has('Q')) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without Q", name),
                "Q, the number of the subroutine with the contour");
  }
  if (state_.modal[plane] != code(18)) {
    return fail("gcode.wrong-plane", motion_span(), fmt::format("{} outside the plane ZX", name), "G18 first");
  }
  if (!(finishes(number) ? check_no_inverse_time(name) : check_cycle(name))) return false;
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

LathePoint LatheCodes::lathe_point(const Point& point) const {
  return LathePoint(point[Axis::z], point[Axis::x]) / state_.length_unit();
}

// Reports what is wrong with the line. A wrong line keeps the cycle from being executed.
void LatheCodes::add_to_contour(bool readable) {
  if (!readable || !add_segment()) contour_->good = false;
}

void LatheCodes::warn_of_unused_words() {
  for (const Word& word : reporter_.block().words) {
    const bool motion_code = word.letter == 'G' && words_.code(motion) != nullptr;
    if (motion_code || contour_letters.has(word.letter)) continue;
    reporter_.warning("gcode.unused-in-contour", word.span,
                      fmt::format("{} has no effect in the contour of a lathe cycle", reporter_.quote(word.span)),
                      "G0 to G3 with X Z U W, I K or R, A or C");
  }
}

bool LatheCodes::add_segment() {
  warn_of_unused_words();
  if (words_.code(motion) != nullptr) {
    const CodeNumber number = words_.code(motion)->number;
    if (number > code(3)) {
      return fail("gcode.bad-contour", words_.span(motion), "the contour of a lathe cycle may only have lines and arcs",
                  "G0, G1, G2 or G3");
    }
    state_.modal.set(motion, number);
  }
  LatheSegment segment;
  segment.line = state_.line;
  segment.start = contour_->corner;
  if (!contour_point(segment.end)) return false;
  if (segment.end == segment.start) return true;
  const CodeNumber active = state_.modal[motion];
  if (active == code(2) || active == code(3)) {
    segment.shape = active == code(2) ? Shape::clockwise : Shape::counterclockwise;
    if (!contour_arc(segment)) return false;
  }
  std::vector<LatheSegment>& segments = contour_->shape.segments;
  if (segments.size() + 2 > most_segments) {
    return fail("gcode.bad-contour", motion_span(),
                fmt::format("the contour has more than {} lines and arcs", most_segments), "fewer");
  }
  segments.push_back(segment);
  contour_->corner = segment.end;
  state_.position[Axis::z] = segment.end.real() * state_.length_unit();
  state_.position[Axis::x] = segment.end.imag() * state_.length_unit();
  return add_corner(segment);
}

// X and Z are absolute or incremental, as in the cycle's block. U and W are always increments.
bool LatheCodes::contour_point(LathePoint& end) {
  const double unit = state_.length_unit();
  const bool incremental = state_.modal.incremental();
  double coordinates[2] = {contour_->corner.real(), contour_->corner.imag()};
  for (const auto& [axis, increment, at] : {std::tuple{Axis::z, 'W', 0}, {Axis::x, 'U', 1}}) {
    const char letter = letter_of(axis);
    if (words_.has(increment) && (words_.has(letter) || incremental)) {
      return fail("gcode.bad-contour", words_.span(increment),
                  fmt::format("{} together with {}, or in incremental distances (G91)", increment, letter),
                  fmt::format("{} or {}, in G90", letter, increment));
    }
    if (words_.has(letter)) {
      coordinates[at] = axis_word(axis) / unit + (incremental ? coordinates[at] : 0);
    } else if (words_.has(increment)) {
      coordinates[at] += words_[increment] * diameter_factor(axis);
    }
  }
  end = {coordinates[0], coordinates[1]};
  return true;
}

bool LatheCodes::contour_arc(LatheSegment& segment) {
  const double unit = state_.length_unit();
  const auto in_plane = [unit](LathePoint point) { return PlanePoint{point.real() * unit, point.imag() * unit}; };
  const ArcTolerance& tolerance = state_.modal.inches() ? arc_tolerance_inch : arc_tolerance_mm;
  const bool by_center = words_.has('I') || words_.has('K');
  ArcCenter found;
  if (by_center && words_.has('R')) {
    return fail("gcode.mixed-arc", words_.span('R'), interpreter_says::radius_and_centre, "R, or I K");
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
    return fail("gcode.missing-center", motion_span(), interpreter_says::no_centre,
                "I and K (or one of them) for the centre, or R");
  }
  segment.center = LathePoint(found.center.first, found.center.second) / unit;
  return report_arc(found);
}

// A rounds the corner after this line. C cuts the corner off.
bool LatheCodes::add_corner(const LatheSegment& behind) {
  if (!words_.has('A') && !words_.has('C')) return true;
  if (words_.has('A') && words_.has('C')) {
    return fail("gcode.bad-contour", words_.span('C'), "A and C on one corner",
                "A, which rounds the corner, or C, which chamfers it");
  }
  LatheSegment corner;
  corner.shape = words_.has('A') ? Shape::fillet : Shape::chamfer;
  corner.size = words_[words_.has('A') ? 'A' : 'C'];
  corner.start = corner.end = behind.end;
  corner.line = behind.line;
  if (corner.size != 0) contour_->shape.segments.push_back(corner);
  return true;
}

bool LatheCodes::end_contour() {
  contour_->open = false;
  words_ = contour_->words;
  block_.source = contour_->source;
  state_.line = contour_->source.line;
  state_.position = contour_->start;
  reporter_.set_block(contour_->block);  // what is found from here on is about the cycle
  if (!contour_->good || reporter_.errors() != contour_->errors_before) return false;
  if (contour_->shape.segments.size() < 2) {
    return fail_contour("the contour has fewer than two lines and arcs",
                        "a line to the start of the contour, then the contour");
  }
  if (!finishes(contour_->code)) lead_out();
  contour_->shape.segments.front().start = lathe_point(contour_->start);
  const LatheFault fault = finishes(contour_->code) ? plan_finishing() : plan_roughing();
  return fault == LatheFault::none || report_contour(fault);
}

// A contour that ends inside the stock gets a line that leads out of it. The line is set off with the contour. If the
// last segment is parallel to an axis, the contour gets no such line here. LatheRoughing then adds one after the
// offset.
void LatheCodes::lead_out() {
  std::vector<LatheSegment>& segments = contour_->shape.segments;
  const LathePoint start = lathe_point(contour_->start);
  const LathePoint end = contour_->corner;
  const LathePoint first = segments.front().end - segments.front().start;
  const LathePoint last = segments.back().end - segments.back().start;
  if (last.real() == 0 || last.imag() == 0) return;
  LatheSegment out;
  out.line = segments.back().line;
  out.start = end;
  if (faces(contour_->code)) {
    if (first.real() * (start.real() - end.real()) >= 0) return;
    out.end = {start.real(), end.imag()};
  } else {
    if (first.imag() * (start.imag() - end.imag()) >= 0) return;
    out.end = {end.real(), start.imag()};
  }
  segments.push_back(out);
}

LatheFault LatheCodes::plan_roughing() {
  LatheContour& contour = contour_->shape;
  if (faces(contour_->code)) contour.turn();
  contour.orient();
  if (const LatheFault fault = contour.work_out_corners(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.check_one_way(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.offset(word('D', 0)); fault != LatheFault::none) return fault;
  for (LatheSegment& segment : contour.segments) segment.move({word('W', 0), word('U', 0)});
  const auto extent = static_cast<LatheRoughing::Extent>(contour_->code % 10);
  begin(LatheRoughing(std::move(contour), extent, word('I', 1), word('R', 0.5)));
  return LatheFault::none;
}

// G70 does not say whether it turns or faces: the contour's direction tells.
LatheFault LatheCodes::plan_finishing() {
  LatheContour& contour = contour_->shape;
  LatheContour part = contour;
  part.segments.erase(part.segments.begin());
  part.orient();
  if (!part.goes_one_way()) contour.turn();
  contour.orient();
  if (const LatheFault fault = contour.work_out_corners(); fault != LatheFault::none) return fault;
  if (const LatheFault fault = contour.check_one_way(); fault != LatheFault::none) return fault;
  const auto passes = static_cast<std::int32_t>(std::round(word('P', 1)));
  begin(LatheFinishing(std::move(contour), word('D', 0), word('E', 0), passes));
  return LatheFault::none;
}

void LatheCodes::begin(std::variant<LatheRoughing, LatheFinishing> cuts) {
  cycle_.emplace(LathePlan{.cuts = std::move(cuts),
                           .start = contour_->start,
                           .unit = state_.length_unit(),
                           .tolerance = state_.modal.inches() ? arc_tolerance_inch : arc_tolerance_mm},
                 contour_->source);
}

bool LatheCodes::finish() {
  if (cycle_->last_motion()) state_.modal.set(motion, *cycle_->last_motion());
  return cycle_->fault() == LatheFault::none || report_contour(cycle_->fault());
}

bool LatheCodes::report_contour(LatheFault fault) {
  switch (fault) {
    case LatheFault::not_monotonic:
      return fail_contour("the contour reverses its direction", faces(contour_->code)
                                                                    ? "X that only increases or only decreases"
                                                                    : "Z that only increases or only decreases");
    case LatheFault::corner:
      return fail_contour("a corner of the contour cannot be rounded or chamfered", "a smaller A or C");
    case LatheFault::parallel:
    case LatheFault::vanished:
      return fail_contour("with the offset D, a part of the contour disappears", "a smaller D, or wider arcs");
    default:
      return fail_contour("the contour has undercuts, which this cycle cannot cut", "a contour without undercuts");
  }
}

bool LatheCodes::fail_contour(FindingWords message, FindingWords expected) {
  return fail("gcode.bad-contour", contour_->span, std::move(message), std::move(expected));
}

}  // namespace passo
