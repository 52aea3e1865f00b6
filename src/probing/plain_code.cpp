#include "plain_code.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>

namespace passo {
namespace {

constexpr double places = 1e5;  // a hundredth of a micrometre

std::int64_t written(double value) {
  return std::llround(value * places);
}

// Without zeros at its end.
void append_number(std::string& text, std::int64_t number) {
  fmt::format_to(std::back_inserter(text), "{:.5f}", static_cast<double>(number) / places);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
}

// The words of a line in capitals, without blanks and comments.
std::string words_of(std::string_view line) {
  std::string words;
  bool in_comment = false;
  for (const char c : line) {
    if (c == ';' && !in_comment) break;
    if (c == '(') in_comment = true;
    if (!in_comment && std::isspace(static_cast<unsigned char>(c)) == 0)
      words += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (c == ')') in_comment = false;
  }
  return words;
}

// Whether the words have this code: not G430 or G43.1 where G43 is asked for.
std::size_t find_code(std::string_view words, std::string_view code) {
  for (std::size_t at = words.find(code); at != std::string_view::npos; at = words.find(code, at + 1)) {
    const std::size_t end = at + code.size();
    const char next = end < words.size() ? words[end] : ' ';
    if (next != '.' && std::isdigit(static_cast<unsigned char>(next)) == 0) return at;
  }
  return std::string_view::npos;
}
bool has_code(std::string_view words, std::string_view code) {
  return find_code(words, code) != std::string_view::npos;
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
  sure_ = AxisSet();
}

void PlainCode::line(std::string_view text) {
  text_.assign(text);
  text_ += '\n';
  write_(text_);
}

void PlainCode::move(const PlainMove& move) {
  text_.clear();
  const int code = move.arc ? (move.arc->clockwise ? 2 : 3) : move.rapid ? 0 : 1;
  if (code != code_ || move.arc) text_ += fmt::format("G{}", code);
  const double from_x = static_cast<double>(at_[Axis::x]) / places;
  const double from_y = static_cast<double>(at_[Axis::y]) / places;
  bool moves = false;
  for (const Axis axis : all_axes) {
    const std::int64_t to = written(move.to[axis]);
    const bool is_in_plane = move.arc && (axis == Axis::x || axis == Axis::y);
    if (at_[axis] == to && (sure_.has(axis) || !move.named.has(axis)) && !is_in_plane) continue;
    if (!text_.empty()) text_ += ' ';
    text_ += letter_of(axis);
    append_number(text_, to);
    at_[axis] = to;
    sure_.add(axis);
    moves = true;
  }
  if (!moves) return;
  if (move.arc) {
    text_ += " I";
    append_number(text_, written(move.arc->center_x - from_x));
    text_ += " J";
    append_number(text_, written(move.arc->center_y - from_y));
  }
  const std::int64_t feed = written(move.feed);
  if (!move.rapid && feed != feed_) {
    text_ += " F";
    append_number(text_, feed);
    feed_ = feed;
  }
  code_ = code;
  text_ += '\n';
  write_(text_);
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

std::optional<std::string> plain_line_of(const Operation& operation) {
  return std::visit(PlainLine{}, operation.what);
}

std::optional<std::string> tool_offset_words(std::string_view line, const Point& offset) {
  const std::string words = words_of(line);
  if (has_code(words, "G49")) return "G49";
  if (has_code(words, "G43.1")) {
    std::string text = "G43.1";
    for (const Axis axis : all_axes) {
      text += fmt::format(" {}{:.5f}", letter_of(axis), offset[axis]);
      if (axis == Axis::z) break;
    }
    return text;
  }
  if (!has_code(words, "G43")) return {};
  const std::size_t h = words.find('H');
  if (h == std::string::npos) return "G43";
  unsigned number = 0;
  const char* const end = words.data() + words.size();
  const auto [rest, error] = std::from_chars(words.data() + h + 1, end, number);
  const bool is_whole = error == std::errc() && (rest == end || (*rest != '.' && *rest != '['));
  return is_whole ? std::optional(fmt::format("G43 H{}", number)) : std::nullopt;
}

bool names_machine_place(std::string_view line) {
  if (line.find('5') == std::string_view::npos && line.find('2') == std::string_view::npos &&
      line.find('3') == std::string_view::npos)
    return false;
  const std::string words = words_of(line);
  return has_code(words, "G53") || has_code(words, "G28") || has_code(words, "G30");
}

}  // namespace passo
