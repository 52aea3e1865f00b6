#include "passo/laser/laser_program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

void extend(std::optional<DrawnBox>& box, DrawnPoint point) {
  if (!box) box = DrawnBox{point, point};
  box->least = {std::min(box->least.x, point.x), std::min(box->least.y, point.y)};
  box->most = {std::max(box->most.x, point.x), std::max(box->most.y, point.y)};
}

// The ends of the arc, and its extreme points in X and Y.
void extend_by_arc(std::optional<DrawnBox>& box, DrawnPoint from, DrawnPoint to, double bulge) {
  extend(box, from);
  extend(box, to);
  if (bulge == 0) return;
  const DrawnPoint off = to_centre(from, to, bulge);
  const DrawnPoint centre{from.x + off.x, from.y + off.y};
  const double radius = distance_nm(centre, from);
  const double start = std::atan2(-static_cast<double>(off.y.count), -static_cast<double>(off.x.count));
  const double sweep = sweep_of(bulge);
  constexpr double turn = 2 * std::numbers::pi;
  for (int k = 0; k < 4; ++k) {
    const double angle = k * std::numbers::pi / 2;
    double way = std::fmod((angle - start) * (sweep > 0 ? 1 : -1), turn);
    if (way < 0) way += turn;
    if (way > std::abs(sweep)) continue;
    extend(box, {{centre.x.count + std::llround(radius * std::cos(angle))},
                 {centre.y.count + std::llround(radius * std::sin(angle))}});
  }
}

double mm_per_second(Nanometres per_minute) {
  return to_mm(per_minute).value() / 60;
}

std::string box_words(const DrawnBox& box) {
  return fmt::format("X {:.4g} to {:.4g}, Y {:.4g} to {:.4g} mm", to_mm(box.least.x).value(), to_mm(box.most.x).value(),
                     to_mm(box.least.y).value(), to_mm(box.most.y).value());
}

std::string time_words(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

std::uint32_t s_of(double percent, std::uint32_t most_s) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(percent, 0.0, 100.0) / 100 * most_s));
}

LaserProgram::LaserProgram(LaserProgramOptions options)
    : options_(std::move(options)), text_(options_.units), at_(options_.park) {
  text_.begin_modes();
  if (options_.focus) text_.line("G0 Z{}", text_.number(*options_.focus));
  if (!options_.air.empty()) text_.line("{}", options_.air);
  text_.line("{} S0", options_.beam == BeamMode::dynamic ? "M4" : "M3");
}

std::string LaserProgram::words_to(DrawnPoint to) const {
  if (!is_terse_ || !is_placed_) return text_.place(to);
  const std::string x = text_.number(to.x);
  const std::string y = text_.number(to.y);
  if (y == text_.number(at_.y)) return "X" + x;
  if (x == text_.number(at_.x)) return "Y" + y;
  return "X" + x + " Y" + y;
}

void LaserProgram::add(int motion, std::string words, std::uint32_t s) {
  if (s != s_) words += fmt::format(" S{}", s);
  if (is_terse_ && motion == motion_) {
    text_.line("{}", words);
  } else {
    text_.line("G{} {}", motion, words);
  }
  motion_ = motion;
  s_ = s;
  ++totals_.lines;
}

void LaserProgram::count(DrawnPoint to, double bulge, bool is_burned) {
  if (is_placed_) extend_by_arc(totals_.moved, at_, to, bulge);
  extend(totals_.moved, to);
  if (is_burned) extend_by_arc(totals_.burned, at_, to, bulge);
  at_ = to;
  is_placed_ = true;
}

void LaserProgram::end_sequence() {
  if (sequence_seconds_ > 0) {
    totals_.seconds += sequence_seconds_ + mm_per_second(feed_) / options_.acceleration.value();
  }
  sequence_seconds_ = 0;
}

void LaserProgram::travel(DrawnPoint to) {
  end_sequence();
  if (is_placed_ && text_.place(to) == text_.place(at_)) return;
  const double length = to_mm({std::llround(distance_nm(at_, to))}).value();
  const double speed = mm_per_second(options_.rapid);
  const double ramps = speed / options_.acceleration.value();  // seconds
  totals_.seconds +=
      length >= speed * ramps ? length / speed + ramps : 2 * std::sqrt(length / options_.acceleration.value());
  add(0, words_to(to), 0);
  count(to, 0, false);
}

void LaserProgram::run(DrawnPoint to, Nanometres feed) {
  feed_move(to, 0, {0, feed});
}

void LaserProgram::burn(DrawnPoint to, double bulge, const BeamSetting& beam) {
  feed_move(to, bulge, beam);
}

void LaserProgram::feed_move(DrawnPoint to, double bulge, const BeamSetting& beam) {
  const bool is_arc = bulge != 0 && to != at_;
  if (!is_arc && text_.place(to) == text_.place(at_)) return;
  std::string words = is_arc ? text_.place(to) : words_to(to);
  if (is_arc) {
    const DrawnPoint centre = to_centre(at_, to, bulge);
    words += " I" + text_.number(centre.x) + " J" + text_.number(centre.y);
  }
  if (beam.feed != feed_) {
    words += " F" + text_.number(beam.feed);
    feed_ = beam.feed;
  }
  const double way = way_nm(at_, to, is_arc ? bulge : 0);
  sequence_seconds_ += way / nanometres_per_mm / mm_per_second(beam.feed);
  if (beam.s > 0) {
    totals_.burned_nm += way;
    totals_.least_s = totals_.most_s == 0 ? beam.s : std::min(totals_.least_s, beam.s);
    totals_.most_s = std::max(totals_.most_s, beam.s);
  }
  add(is_arc ? (bulge > 0 ? 3 : 2) : 1, std::move(words), beam.s);
  count(to, is_arc ? bulge : 0, beam.s > 0);
}

void LaserProgram::lower(Nanometres z) {
  end_sequence();
  add(0, "Z" + text_.number(z), 0);
}

std::string LaserProgram::head() const {
  ProgramText text(options_.units);
  text.line("({}, by passo cam laser)", in_comment(options_.name));
  for (const std::string& file : options_.files) text.line("(from {})", in_comment(file));
  for (const std::string& remark : options_.remarks) text.line("({})", in_comment(remark));
  if (totals_.burned) text.line("(burned: {})", box_words(*totals_.burned));
  if (totals_.moved) text.line("(the head moves within {})", box_words(*totals_.moved));
  const bool has_one = totals_.least_s == totals_.most_s;
  text.line("(power: S{}{} of S{}, {})", has_one ? "" : fmt::format("{} to S", totals_.least_s), totals_.most_s,
            options_.most_s,
            options_.beam == BeamMode::dynamic ? "M4: it follows the speed" : "M3: constant, also in corners");
  text.line("(about {}, with rapids at {:.6g} mm/min and {:.6g} mm/s2)", time_words(totals_.seconds),
            to_mm(options_.rapid).value(), options_.acceleration.value());
  text.line("(Grbl needs $30={} and laser mode, $32=1)", options_.most_s);
  return text.take();
}

std::string LaserProgram::finish() {
  end_sequence();
  text_.line("M5");
  if (!options_.air.empty()) text_.line("M9");
  is_terse_ = false;
  travel(options_.park);
  text_.line("M2");
  return head() + text_.take();
}

}  // namespace passo
