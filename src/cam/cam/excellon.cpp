#include "passo/cam/excellon.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>

#include "drawing_builder.hpp"
#include "excellon_numbers.hpp"
#include "excellon_tools.hpp"
#include "excellon_words.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_drill_line = 4096;
constexpr std::int64_t highest_tool = 9999;

// Words of headers that say nothing about where the holes are.
constexpr std::array ignored_words = {
    "FMAT,2", "ATC",  "VER,", "DETECT",   "OSTOP",   "FSB", "SBK", "TCST", "BLKD",  "UP,",  "R,T", "R,C",    "R,D",
    "R,H",    "R,CP", "R,CR", "PCKPARAM", "ICI,OFF", "AFS", "CCW", "CP,",  "MERGE", "STOP", "M47", "SBKOFF", "VER"};

class ExcellonReader {
 public:
  ExcellonReader(const std::string& name, std::string_view text, const ExcellonOptions& options,
                 Diagnostics& diagnostics)
      : lines_(text),
        builder_(name, diagnostics),
        diagnostics_(diagnostics),
        numbers_(text, options, notes_),
        has_plunges_(text.find("M15") != std::string_view::npos || text.find("M14") != std::string_view::npos) {
    for (std::string& words : notes_) builder_.note(std::move(words));
  }

  Drawing read() {
    while (!ended_ && !diagnostics_.full() && !builder_.is_full() && lines_.next(line_)) {
      read_line(trimmed(line_));
    }
    finish_route();
    if (!ended_ && !diagnostics_.any_error()) builder_.note("the file does not end with M30, so it may be truncated");
    Drawing drawing = builder_.take();
    tools_.add_late_sizes(drawing);
    return drawing;
  }

 private:
  void read_line(std::string_view text);
  void read_comment(std::string_view text);
  bool read_words(std::string_view text);
  void obey();
  bool obey_code(const DrillWord& word);
  bool obey_g(const DrillWord& word, std::int64_t code);
  bool obey_m(const DrillWord& word, std::int64_t code);
  bool choose_tool();
  void end_header();
  void move();
  void add_slot(DrawnPoint from);
  void add_repeats(const DrillWord& count);
  void arc_to(DrawnPoint from, DrawnPoint to);
  bool read_place(char x, char y, DrawnPoint& place);
  void drill(DrawnPoint at);
  void begin_route();
  void finish_route();

  const DrillWord* word_of(char letter) const {
    const auto found = std::ranges::find(words_, letter, &DrillWord::letter);
    return found == words_.end() ? nullptr : &*found;
  }
  SourceLocation place_of(const DrillWord& word) const {
    return {lines_.number(), word.column, static_cast<std::uint32_t>(word.number.size() + 1)};
  }
  SourceLocation whole_line() const {
    return {lines_.number(), 1, std::max<std::uint32_t>(1, static_cast<std::uint32_t>(line_.size()))};
  }
  bool refuse(const SourceLocation& place, const char* code, std::string message, std::string expected) {
    diagnostics_.add({.code = code,
                      .file = builder_.drawing().file,
                      .place = place,
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = std::string(line_.substr(0, longest_drill_line))});
    return false;
  }
  std::optional<std::int64_t> count_of(const DrillWord& word);

  TextLines lines_;
  DrawingBuilder builder_;
  Diagnostics& diagnostics_;
  std::vector<std::string> notes_;
  ExcellonNumbers numbers_;

  std::string_view line_;
  std::vector<DrillWord> words_;
  ExcellonTools tools_;
  DrawnPoint now_;
  DrawnPoint zero_;           // G93: where the file's zero is
  bool incremental_ = false;  // G91, ICI
  bool routing_ = false;      // G00 to G03; else each place is a hole
  bool is_down_ = false;      // M15
  int route_code_ = 0;        // 0 to 3
  bool in_header_ = false;
  bool has_plunges_ = false;  // M14 or M15; otherwise a route is cut from its first G01
  bool format_1_ = false;
  bool ended_ = false;
  DrawnPath route_;
};

void ExcellonReader::read_comment(std::string_view text) {
  const std::optional<CommentedTool> found = numbers_.commented_tool(text);
  if (!found || found->number > highest_tool) return;
  FileTool& tool = tools_.named(found->number, builder_);
  if (!tool.diameter) tool.diameter = builder_.length(found->diameter, whole_line(), line_);
}

void ExcellonReader::read_line(std::string_view text) {
  if (text.empty()) return;
  if (text.front() == ';') return read_comment(text);
  if (line_.size() > longest_drill_line) {
    refuse({lines_.number(), 1, 1}, "excellon.long-line", fmt::format("the line has {} bytes", line_.size()),
           fmt::format("at most {}", longest_drill_line));
    return;
  }
  if (text == "%" || text == "M95") {
    if (text == "%" && !in_header_ && !builder_.drawing().holes.empty()) ended_ = true;  // rewind
    in_header_ = false;
    return;
  }
  if (text == "M48") {
    in_header_ = true;
    return;
  }
  if (text == "FMAT,1") {
    format_1_ = true;
    return;
  }
  if (text == "ICI" || text == "ICI,ON") {
    incremental_ = true;
    return;
  }
  if (numbers_.read_units(text)) return;
  const auto begins = [text](const char* word) { return text.starts_with(word); };
  if (std::ranges::any_of(ignored_words, begins)) return;
  if (text.front() == '/') text.remove_prefix(1);
  if (read_words(text)) obey();
}

bool ExcellonReader::read_words(std::string_view text) {
  const auto first_column = static_cast<std::uint32_t>(text.data() - line_.data()) + 1;
  if (const std::optional<DrillWordFault> fault = scan_drill_words(text, first_column, words_)) {
    return refuse({lines_.number(), fault->column, 1}, "excellon.unknown-command", fault->message, fault->expected);
  }
  return !words_.empty();
}

std::optional<std::int64_t> ExcellonReader::count_of(const DrillWord& word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.number.data(), word.number.data() + word.number.size(), value);
  if (error == std::errc() && end == word.number.data() + word.number.size() && value >= 0) return value;
  refuse(place_of(word), "excellon.bad-number", fmt::format("'{}' is not a whole number", word.number), "digits only");
  return std::nullopt;
}

// A header without a "%" ends at the first place.
void ExcellonReader::end_header() {
  if (in_header_) tools_.end_header();
  in_header_ = false;
}

// What a line says: first its modes and its tool, then where it goes.
void ExcellonReader::obey() {
  const bool is_place = word_of('X') != nullptr || word_of('Y') != nullptr;
  if (words_.front().letter == 'T') {
    if (!choose_tool() || !is_place) return;
  }
  const DrawnPoint from = now_;
  bool is_slot = false;
  for (const DrillWord& word : words_) {
    if (word.letter == 'G' && word.number == "85") is_slot = true;
    if ((word.letter == 'G' || word.letter == 'M') && !is_slot && !obey_code(word)) return;
  }
  if (ended_) return;
  if (is_slot) {
    end_header();
    add_slot(from);
  } else if (words_.front().letter == 'R') {
    add_repeats(words_.front());
  } else if (is_place) {
    if (words_.front().letter == 'G' && words_.front().number == "93") return;  // obeyed as a code
    end_header();
    move();
  }
}

bool ExcellonReader::obey_code(const DrillWord& word) {
  const std::optional<std::int64_t> code = count_of(word);
  if (!code) return false;
  return word.letter == 'G' ? obey_g(word, *code) : obey_m(word, *code);
}

bool ExcellonReader::obey_g(const DrillWord& word, std::int64_t code) {
  switch (code) {
    case 0:
    case 1:
    case 2:
    case 3:
      if (code == 0) finish_route();
      routing_ = true;
      route_code_ = static_cast<int>(code);
      return true;
    case 5:
    case 80:
    case 81:
      finish_route();
      routing_ = false;
      return true;
    case 90: incremental_ = false; return true;
    case 91: incremental_ = true; return true;
    case 93: {
      DrawnPoint place;
      now_ = {};
      zero_ = {};
      if (!read_place('X', 'Y', place)) return false;
      zero_ = place;
      now_ = place;
      return true;
    }
    case 4:  // a dwell
    case 7:  // cycles of depth and speed that leave the place alone
    case 34:
    case 35:
    case 36:
    case 38:
    case 40: return true;
    case 41:
    case 42:
      builder_.note(fmt::format("line {}: cutter compensation (G{}) is ignored; routes are cut along their line",
                                lines_.number(), code));
      return true;
    default:
      return refuse(place_of(word), "excellon.unsupported", fmt::format("G{} is not supported", code),
                    "holes, slots (G85) and routes (G00 to G03)");
  }
}

bool ExcellonReader::obey_m(const DrillWord& word, std::int64_t code) {
  const bool has_place = word_of('X') != nullptr || word_of('Y') != nullptr;
  switch (code) {
    case 0:
    case 30: ended_ = true; return true;
    case 2:
      if (has_place) break;
      ended_ = format_1_ || !in_header_;
      return true;
    case 14:
    case 15: begin_route(); return true;
    case 16:
    case 17: finish_route(); return true;
    case 71: numbers_.use_inches(false); return true;
    case 72: numbers_.use_inches(true); return true;
    case 6:
    case 9:
    case 18:
    case 47:
    case 50:
    case 97:
    case 98: return true;
    default: break;
  }
  return refuse(place_of(word), "excellon.unsupported",
                fmt::format("M{}{} is not supported", code, has_place ? " X Y" : ""),
                "holes, slots and routes; export them without step and repeat");
}

// T1C0.8 in the header, T1 before its holes, or both in one. "T01" and "T1" are one tool; T0 is none, unless
// the header defines it.
bool ExcellonReader::choose_tool() {
  const DrillWord& word = words_.front();
  std::string_view digits = word.number;
  if (digits.size() == 4 && !in_header_ && word_of('C') == nullptr) digits = digits.substr(0, 2);  // with its offset
  const std::optional<std::int64_t> number = count_of({'T', digits, word.column});
  if (!number) return false;
  if (*number > highest_tool) {
    return refuse(place_of(word), "excellon.bad-number", fmt::format("T{} is not a tool", *number), "T1 to T9999");
  }
  finish_route();
  if (*number == 0 && word_of('C') == nullptr && !tools_.has(0)) {
    tools_.select_none();
    return true;
  }
  const DrillWord* const diameter = word_of('C');
  FileTool& tool = tools_.named(*number, builder_);
  if (diameter != nullptr) {
    const std::optional<Mm> value = numbers_.diameter(diameter->number);
    if (!value || value->value() < 0) {
      return refuse(place_of(*diameter), "excellon.bad-number", fmt::format("'{}' is not a diameter", diameter->number),
                    "a number, e.g. T1C0.8");
    }
    tool.diameter = builder_.length(*value, place_of(*diameter), line_);
  }
  if (!in_header_) {
    tools_.select(tool);
  } else if (diameter == nullptr) {
    tools_.select_in_header(tool);
  }
  return true;
}

bool ExcellonReader::read_place(char x, char y, DrawnPoint& place) {
  std::array<double, 2> value = {to_mm(now_.x - zero_.x).value(), to_mm(now_.y - zero_.y).value()};
  const std::array<char, 2> letters = {x, y};
  const DrillWord* last = nullptr;
  for (std::size_t i = 0; i < 2; ++i) {
    const DrillWord* const word = word_of(letters[i]);
    if (word == nullptr) continue;
    last = word;
    const std::optional<Mm> number = numbers_.coordinate(word->number);
    if (!number) {
      return refuse(place_of(*word), "excellon.bad-number", fmt::format("'{}' is not a coordinate", word->number),
                    "at most 15 digits, with or without a decimal point");
    }
    value[i] = incremental_ ? value[i] + number->value() : number->value();
  }
  const auto point = builder_.point(Mm(value[0] + to_mm(zero_.x).value()), Mm(value[1] + to_mm(zero_.y).value()),
                                    last == nullptr ? whole_line() : place_of(*last), line_);
  if (point) place = *point;
  return point.has_value();
}

void ExcellonReader::drill(DrawnPoint at) {
  if (tools_.selected() == nullptr) {
    refuse(whole_line(), "excellon.no-tool", "a hole without a selected tool",
           "T1, or another tool, in an earlier line");
    return;
  }
  if (!builder_.has_room_for(1, whole_line(), line_)) return;
  builder_.add_hole(
      {at, tools_.selected()->diameter.value_or(Nanometres{}), tools_.selected()->layer, lines_.number()});
}

void ExcellonReader::move() {
  DrawnPoint to;
  if (!read_place('X', 'Y', to)) return;
  const DrawnPoint from = now_;
  now_ = to;
  if (!routing_) {
    drill(to);
    return;
  }
  if (!is_down_ && !has_plunges_ && route_code_ != 0) {
    now_ = from;
    begin_route();
    now_ = to;
  }
  if (!is_down_ || route_code_ == 0) return;
  if (route_code_ == 1) {
    if (!builder_.has_room_for(1, whole_line(), line_)) return;
    route_.points.push_back({to});
  } else {
    arc_to(from, to);
  }
}

// G02 and G03 tell their radius by A, or their centre from the start by I and J.
void ExcellonReader::arc_to(DrawnPoint from, DrawnPoint to) {
  const double sense = route_code_ == 3 ? 1 : -1;
  const double chord = distance_nm(from, to);
  double sweep = 0;
  if (const DrillWord* const radius = word_of('A')) {
    const std::optional<Mm> value = numbers_.coordinate(radius->number);
    const double r = value ? value->value() * nanometres_per_mm : 0;
    if (!(r > 0) || chord > 2 * r * 1.001) {
      refuse(place_of(*radius), "excellon.bad-arc", "no arc of this radius joins start and end",
             fmt::format("A of {:g} mm or more", chord / 2 / nanometres_per_mm));
      return;
    }
    sweep = 2 * std::asin(std::min(1.0, chord / (2 * r)));
  } else {
    const auto part = [&](char letter) {
      const DrillWord* const word = word_of(letter);
      return word == nullptr ? Mm(0) : numbers_.coordinate(word->number).value_or(Mm(0));
    };
    const double i = part('I').value() * nanometres_per_mm;
    const double j = part('J').value() * nanometres_per_mm;
    if (i == 0 && j == 0) {
      refuse(whole_line(), "excellon.bad-arc", "the arc has neither a radius nor a centre", "A, or I and J");
      return;
    }
    const double end_x = static_cast<double>(to.x.count - from.x.count) - i;
    const double end_y = static_cast<double>(to.y.count - from.y.count) - j;
    sweep = sense * (std::atan2(end_y, end_x) - std::atan2(-j, -i));
    if (sweep <= 1e-9) sweep += 2 * std::numbers::pi;
  }
  if (sweep > 1.5 * std::numbers::pi && chord < 1) {  // a full circle has no bulge
    refuse(whole_line(), "excellon.bad-arc", "a full circle as one arc is not supported", "two half circles");
    return;
  }
  if (!builder_.has_room_for(1, whole_line(), line_)) return;
  if (!route_.points.empty()) route_.points.back().bulge = sense * std::tan(sweep / 4);
  route_.points.push_back({to});
}

void ExcellonReader::begin_route() {
  finish_route();
  if (tools_.selected() == nullptr) {
    refuse(whole_line(), "excellon.no-tool", "a route without a selected tool",
           "T1, or another tool, in an earlier line");
    return;
  }
  is_down_ = true;
  route_.points = {{now_}};
  route_.width = tools_.selected()->diameter.value_or(Nanometres{});
  route_.layer = tools_.selected()->layer;
  route_.line = lines_.number();
}

void ExcellonReader::finish_route() {
  if (is_down_) builder_.add_path(std::move(route_));
  route_ = {};
  is_down_ = false;
}

// X1Y1G85X2Y2: the words before G85 are where the slot begins, those behind it where it ends.
void ExcellonReader::add_slot(DrawnPoint from) {
  now_ = from;
  const auto g85 = std::ranges::find_if(words_, [](const DrillWord& w) { return w.letter == 'G' && w.number == "85"; });
  const std::vector<DrillWord> all = words_;
  const auto index = static_cast<std::size_t>(g85 - words_.begin());
  DrawnPoint begin;
  DrawnPoint end;
  words_.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(index));
  if (!read_place('X', 'Y', begin)) return;
  now_ = begin;
  words_.assign(all.begin() + static_cast<std::ptrdiff_t>(index) + 1, all.end());
  if (!read_place('X', 'Y', end)) return;
  now_ = end;
  if (tools_.selected() == nullptr) {
    refuse(whole_line(), "excellon.no-tool", "a slot without a selected tool",
           "T1, or another tool, in an earlier line");
    return;
  }
  if (!builder_.has_room_for(2, whole_line(), line_)) return;
  builder_.add_path({.points = {{begin}, {end}},
                     .is_closed = false,
                     .width = tools_.selected()->diameter.value_or(Nanometres{}),
                     .layer = tools_.selected()->layer,
                     .line = lines_.number()});
}

// R5X2.54: the last hole five times more, each so far from the one before.
void ExcellonReader::add_repeats(const DrillWord& count) {
  const std::optional<std::int64_t> times = count_of(count);
  if (!times) return;
  const bool was_incremental = std::exchange(incremental_, true);
  for (std::int64_t i = 0; i < *times && !builder_.is_full() && !diagnostics_.full(); ++i) {
    DrawnPoint next;
    if (!read_place('X', 'Y', next)) break;
    now_ = next;
    drill(next);
  }
  incremental_ = was_incremental;
}

}  // namespace

Drawing read_excellon(const std::string& name, std::string_view text, const ExcellonOptions& options,
                      Diagnostics& diagnostics) {
  return ExcellonReader(name, text, options, diagnostics).read();
}

bool looks_like_excellon(std::string_view text) {
  TextLines lines(text);
  int looked_at = 0;
  for (std::string_view line; looked_at < 200 && lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == ';') continue;
    ++looked_at;
    if (line == "M48" || line == "%" || line == "M71" || line == "M72" || line.starts_with("METRIC") ||
        line.starts_with("INCH")) {
      return true;
    }
    if (line.size() > 1 && line.front() == 'T' && line[1] >= '0' && line[1] <= '9') return true;
    if (looked_at == 1 && line.front() == '0') return false;
  }
  return false;
}

}  // namespace passo
