#include "plain_code.hpp"

#include <cmath>
#include <iterator>

namespace passo {
namespace {

constexpr double places_a_mm = 1e5;  // a hundredth of a micrometre

std::int64_t written(double value) {
  return std::llround(value * places_a_mm);
}

// Without zeros at its end.
void append_number(std::string& text, double number, int decimals) {
  fmt::format_to(std::back_inserter(text), "{:.{}f}", number, decimals);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  if (text.ends_with("-0")) text.erase(text.size() - 2, 1);
}
void append_number(std::string& text, std::int64_t number) {
  append_number(text, static_cast<double>(number) / places_a_mm, 5);
}

std::string in_parentheses(std::string_view before, std::string_view text) {
  std::string comment = "(";
  comment += before;
  for (const char c : text) comment += c == '(' ? '[' : c == ')' ? ']' : static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return comment + ")";
}

// Each of them is called with one kind of operation.
struct PlainLine {
  using Line = std::optional<std::string>;
  static Line nothing() { return std::string(); }

  Line operator()(const operation::SelectPlane&) const { return nothing(); }
  Line operator()(const operation::SetLengthUnits&) const { return nothing(); }
  Line operator()(const operation::SetFeedReference&) const { return nothing(); }
  Line operator()(const operation::Reset&) const { return nothing(); }
  Line operator()(const operation::StartToolChange&) const { return nothing(); }
  Line operator()(const operation::Finish&) const { return nothing(); }
  Line operator()(const operation::Log&) const { return nothing(); }
  // Written with the block that sets the tool: the operation does not say all its words.
  Line operator()(const operation::SetToolTableEntry&) const { return nothing(); }
  Line operator()(const operation::ReloadTools&) const { return nothing(); }
  Line operator()(const operation::SetFeedMode& set) const {
    return set.mode == FeedMode::units_per_minute ? nothing() : std::nullopt;
  }
  Line operator()(const operation::Dwell& dwell) const { return fmt::format("G4 P{:.4f}", dwell.time.value()); }
  Line operator()(const operation::SetSpindleSpeed& set) const {
    return set.spindle == 0 ? Line(fmt::format("S{:.3f}", set.revolutions_per_minute)) : std::nullopt;
  }
  Line operator()(const operation::SetSpindleMode& set) const {
    return set.surface_limit == 0 ? nothing() : std::nullopt;
  }
  Line operator()(const operation::TurnSpindle& set) const {
    if (set.spindle != 0) return {};
    return set.direction == SpindleDirection::off ? "M5" : set.direction == SpindleDirection::clockwise ? "M3" : "M4";
  }
  Line operator()(const operation::SetMist& set) const { return set.on ? "M7" : "M9"; }
  Line operator()(const operation::SetFlood& set) const { return set.on ? "M8" : "M9"; }
  Line operator()(const operation::SetFeedOverride& set) const { return fmt::format("M50 P{:d}", set.on); }
  Line operator()(const operation::SetSpeedOverride& set) const { return fmt::format("M51 P{:d}", set.on); }
  Line operator()(const operation::SetAdaptiveFeed& set) const { return fmt::format("M52 P{:d}", set.on); }
  Line operator()(const operation::SetFeedHold& set) const { return fmt::format("M53 P{:d}", set.on); }
  Line operator()(const operation::SetDigitalOutput& set) const {
    const int code = (set.with_motion ? 62 : 64) + (set.on ? 0 : 1);
    return fmt::format("M{} P{}", code, set.output);
  }
  Line operator()(const operation::SetAnalogOutput& set) const {
    return fmt::format("M{} E{} Q{:g}", set.with_motion ? 67 : 68, set.output, set.value);
  }
  Line operator()(const operation::SelectTool& select) const { return fmt::format("T{}", select.tool); }
  Line operator()(const operation::ChangeTool&) const { return "M6"; }
  Line operator()(const operation::SetToolNumber& set) const { return fmt::format("M61 Q{}", set.tool); }
  Line operator()(const operation::ProgramStop&) const { return "M0"; }
  Line operator()(const operation::OptionalProgramStop&) const { return "M1"; }
  Line operator()(const operation::PalletShuttle&) const { return nothing(); }
  Line operator()(const operation::ProgramEnd&) const { return "M2"; }
  Line operator()(const operation::Comment& comment) const {
    return comment.text.starts_with("interpreter:") ? nothing() : in_parentheses("", comment.text);
  }
  Line operator()(const operation::Message& message) const { return in_parentheses("MSG,", message.text); }
  Line operator()(const operation::Print& print) const { return in_parentheses("PRINT,", print.text); }
  template <class Other>
  Line operator()(const Other&) const {
    return {};
  }
};

}  // namespace

void PlainCode::stand_at(const Point& place) {
  for (const Axis axis : all_axes) at_[axis] = written(place[axis]);
}

void PlainCode::forget(AxisSet axes) {
  for (const Axis axis : all_axes) {
    if (axes.has(axis)) known_.remove(axis);
  }
}

void PlainCode::line(std::string_view text) {
  text_.assign(text);
  write_line();
}

void PlainCode::write_line() {
  text_ += '\n';
  write_(text_);
  text_.clear();
}

void PlainCode::write_mode(bool incremental) {
  if (incremental == is_incremental_) return;
  is_incremental_ = incremental;
  text_ += incremental ? "G91" : "G90";
}

void PlainCode::write_feed(double feed) {
  const std::int64_t number = written(feed);
  if (number == feed_) return;
  text_ += " F";
  append_number(text_, number);
  feed_ = number;
}

void PlainCode::move(const PlainMove& move) {
  // A full circle ends where it begins, to the last bit: its end is not written.
  const auto stays_at = [&](Axis axis) { return at_[axis] == written(move.to[axis]); };
  const bool is_closed = move.arc && stays_at(Axis::x) && stays_at(Axis::y);
  AxisSet places;
  AxisSet ways;
  bool any_new_place = false;
  for (const Axis axis : all_axes) {
    const bool is_known = known_.has(axis);
    const bool is_place = is_known || move.absolute.has(axis);
    const bool is_in_plane = move.arc && !is_closed && (axis == Axis::x || axis == Axis::y);
    const bool stays = stays_at(axis) && (!is_place || is_known || !move.named.has(axis));
    if (stays && !is_in_plane) continue;
    (is_place ? places : ways).add(axis);
    any_new_place = any_new_place || (is_place && !is_known);
  }
  if (places.empty() && ways.empty() && !is_closed) return;
  const bool incremental = !ways.empty() && !any_new_place;
  write_mode(incremental);
  const int code = move.arc ? (move.arc->clockwise ? 2 : 3) : move.rapid ? 0 : 1;
  if (code != code_ || move.arc) text_ += fmt::format("{}G{}", text_.empty() ? "" : " ", code);
  const double from_x = static_cast<double>(at_[Axis::x]) / places_a_mm;
  const double from_y = static_cast<double>(at_[Axis::y]) / places_a_mm;
  for (const Axis axis : all_axes) {
    if (!places.has(axis) && !ways.has(axis)) continue;
    const std::int64_t to = written(move.to[axis]);
    const std::int64_t way = to - at_[axis];
    if (!text_.empty()) text_ += ' ';
    text_ += letter_of(axis);
    if (incremental) {
      append_number(text_, way);
    } else if (places.has(axis)) {
      append_number(text_, to);
      known_.add(axis);
    } else {  // a place and a way cannot be in one block: #5420 and what follows is where the axes stand
      text_ += fmt::format("[#{}{}", 5420 + index_of(axis), way < 0 ? "" : "+");
      append_number(text_, way);
      text_ += ']';
    }
    at_[axis] = to;
  }
  if (move.arc) {
    text_ += " I";
    append_number(text_, written(move.arc->center_x - from_x));
    text_ += " J";
    append_number(text_, written(move.arc->center_y - from_y));
  }
  if (!move.rapid) write_feed(move.feed);
  code_ = code;
  write_line();
}

// With all the digits that a number of the program may have: a place of the machine stays what it is.
void PlainCode::machine_move(bool rapid, double feed, AxisSet axes, const Point& machine) {
  write_mode(false);
  text_ += fmt::format("{}G53 G{}", text_.empty() ? "" : " ", rapid ? 0 : 1);
  for (const Axis axis : all_axes) {
    if (!axes.has(axis)) continue;
    text_ += fmt::format(" {}", letter_of(axis));
    append_number(text_, machine[axis], 10);
  }
  if (!rapid) write_feed(feed);
  code_ = rapid ? 0 : 1;
  write_line();
}

void PlainCode::cycle(std::string_view code, std::string_view words, double feed, const Point& end,
                      bool is_height_known) {
  write_mode(false);
  if (!text_.empty()) text_ += ' ';
  text_ += code;
  stand_at(end);
  for (const Axis axis : {Axis::x, Axis::y}) {
    text_ += fmt::format(" {}", letter_of(axis));
    append_number(text_, at_[axis]);
    known_.add(axis);
  }
  if (is_height_known) known_.add(Axis::z);
  text_ += words;
  write_feed(feed);
  code_ = -1;
  write_line();
}

void PlainCode::home(std::string_view code, AxisSet axes) {
  if (!axes.empty()) write_mode(true);
  if (!text_.empty()) text_ += ' ';
  text_ += code;
  for (const Axis axis : all_axes) {
    if (axes.has(axis)) text_ += fmt::format(" {}0", letter_of(axis));
  }
  write_line();
}

std::string path_mode_line(const operation::SetPathMode& mode, Mm merge) {
  if (mode.mode == PathMode::exact_path) return "G61";
  if (mode.mode == PathMode::exact_stop) return "G61.1";
  std::string line = "G64";
  if (mode.tolerance > Mm(0)) line += fmt::format(" P{:.5f}", mode.tolerance.value());
  if (merge != mode.tolerance) line += fmt::format(" Q{:.5f}", merge.value());
  return line;
}

std::string code_of_system(int system) {
  return system <= 6 ? fmt::format("G{}", 53 + system) : fmt::format("G59.{}", system - 6);
}

int system_of_code(std::string_view code) {
  const int tenth = code.size() > 4 ? code[4] - '0' : 0;
  return code[2] - '0' - 3 + tenth;
}

std::optional<std::string> plain_line_of(const Operation& operation) {
  return std::visit(PlainLine{}, operation.what);
}

}  // namespace passo
