#include "passo/post_processor/post_processor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "arc_parts.hpp"
#include "program_words.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// 0 for the letter of the X axis, and so on.
std::size_t place_of(char letter, char first) {
  return static_cast<std::size_t>(letter - first);
}

constexpr double mm_of(LengthUnit unit) {
  return unit == LengthUnit::mm ? 1 : unit == LengthUnit::cm ? 10 : 25.4;
}

const char* name_of(LengthUnit unit) {
  return unit == LengthUnit::mm ? "mm" : unit == LengthUnit::cm ? "cm" : "inch";
}

constexpr std::string_view lengths = "XYZUVWIJKRQ";

}  // namespace

// Reads line by line, and follows the modal state of what it reads and of what it writes.
class PostProcessor::Lines {
 public:
  Lines(const ControllerWords& controller, PostProcessorOptions options, Sink sink)
      : controller_(controller), options_(std::move(options)), sink_(std::move(sink)) {
    scale_ = mm_of(options_.read_unit) / mm_of(options_.written_unit);
    tool_ = options_.first_tool;
    decimals_ =
        options_.written_unit == LengthUnit::mm ? controller.numbers.mm_decimals : controller.numbers.inch_decimals;
    digit_ = std::pow(10.0, -decimals_);
  }

  void read(std::string_view line);
  std::optional<std::string> finish();
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  void begin();
  void write_modes();
  void call_tool(std::uint32_t number);
  void end();
  void move();
  void write_arc();
  void write_part(const ProgrammedArc& arc, const ArcPart& part, bool is_first);
  void write_dwell(double seconds);
  void write_other();
  void write_operator_text(const OperatorText& text);
  void write_comment(std::string_view comment);

  // The words of one line that is being written.
  void add_word(char letter, std::string_view number) {
    if (!line_.empty()) line_ += ' ';
    line_ += letter;
    line_ += number;
  }
  void add_length(char letter, double value) { add_word(letter, length(value)); }
  void add_code(char letter, double value);
  void add_motion(int code);
  void end_line();
  void emit(std::string_view line);

  std::string length(double value) const;
  std::string clean(std::string_view comment) const;
  void refuse(std::string why) {
    if (error_.empty()) error_ = fmt::format("line {}: {}", number_, why);
  }

  const ControllerWords& controller_;
  PostProcessorOptions options_;
  Sink sink_;
  ProgramWords words_;
  std::string text_;
  std::string line_;
  std::string error_;
  std::array<double, 3> at_{};  // the last position, in the unit that is written
  double scale_ = 1;
  double digit_ = 1;
  int decimals_ = 4;
  std::uint32_t number_ = 0;  // of the line that is read
  std::uint32_t tool_ = 1;
  std::uint32_t called_length_ = 0;  // tool whose G43 is still to be written; 0: none
  int line_number_ = 0;
  int read_motion_ = -1;
  int written_motion_ = -1;
  int plane_ = 17;
  bool has_begun_ = false;
  bool is_inverse_time_ = false;
};

std::string PostProcessor::Lines::length(double value) const {
  std::string digits = fmt::format("{:.{}f}", value, decimals_);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits == "-0.") digits = "0.";
  if (!controller_.numbers.has_point && digits.back() == '.') digits.pop_back();
  return digits;
}

// Comments are in brackets; a semicolon begins a comment for some controllers, and ends a line for others.
std::string PostProcessor::Lines::clean(std::string_view comment) const {
  const CommentForm& form = controller_.comments;
  std::string text;
  for (std::size_t i = 0; i < comment.size(); ++i) {
    auto byte = static_cast<unsigned char>(comment[i]);
    const bool is_follow_up = byte >= 0x80 && byte < 0xC0;
    if (form.is_ascii && is_follow_up) continue;  // of a letter that was replaced
    if (form.is_ascii && byte >= 0x80) byte = '_';
    char c = static_cast<char>(byte);
    if (form.realtime.find(c) != std::string_view::npos || c == ';') c = '_';
    if (form.has_capitals_only) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
      constexpr std::string_view signs = " .,+-*/=#_";
      const bool is_plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || signs.find(c) != std::string_view::npos;
      if (!is_plain) c = ' ';
    }
    text += c;
  }
  return text;
}

void PostProcessor::Lines::emit(std::string_view line) {
  const int step = controller_.form.line_step;
  if (step > 0) {
    constexpr int most = 99'999;
    line_number_ = line_number_ + step > most ? step : line_number_ + step;
    text_ += fmt::format("N{} ", line_number_);
  }
  text_ += line;
  text_ += '\n';
  constexpr std::size_t piece = 65'536;
  if (text_.size() >= piece) flush();
}

void PostProcessor::Lines::end_line() {
  if (!line_.empty()) emit(line_);
  line_.clear();
}

void PostProcessor::Lines::begin() {
  if (has_begun_) return;
  has_begun_ = true;
  if (!controller_.form.has_frame) return;
  text_ += fmt::format("%\nO0001 ({})\n", clean(options_.program));
}

// A comment that is longer than a line continues in the next one.
void PostProcessor::Lines::write_comment(std::string_view comment) {
  std::string text = clean(comment);
  if (text.starts_with("MSG,") && !controller_.comments.has_messages) {
    text.erase(0, std::min(text.find_first_not_of(' ', 4), text.size()));
  }
  const std::size_t longest = controller_.comments.longest_line;
  constexpr std::size_t frame = 10;  // brackets and a line number
  const std::size_t room = longest == 0 ? text.size() : longest - frame;
  std::string_view rest = text;
  while (rest.size() > room) {
    const std::size_t blank = rest.rfind(' ', room);
    const std::size_t cut = blank == std::string_view::npos || blank == 0 ? room : blank;
    emit(fmt::format("({})", rest.substr(0, cut)));
    rest.remove_prefix(cut);
    while (rest.starts_with(' ')) rest.remove_prefix(1);
  }
  if (!rest.empty()) emit(fmt::format("({})", rest));
}

void PostProcessor::Lines::add_code(char letter, double value) {
  const std::string number = code_number(value);
  const bool is_known = letter == 'G' ? controller_.knows_g(number) : controller_.knows_m(number);
  if (!is_known) refuse(fmt::format("{} does not know {}{}", controller_.title, letter, number));
  if (letter == 'M' && number == "7" && controller_.lacks_mist) {
    refuse(fmt::format("{} knows M7, mist coolant, only if it was built with ENABLE_M7; M8 is flood coolant",
                       controller_.title));
  }
  add_word(letter, number);
}

// Repeated words are kept, because operators start programs in the middle.
void PostProcessor::Lines::add_motion(int code) {
  if (written_motion_ == code && !words_.has('G', code)) return;
  written_motion_ = code;
  add_code('G', code);
}

void PostProcessor::Lines::write_operator_text(const OperatorText& text) {
  if (text.empty()) return;
  const bool has_tool = tool_ >= 1 && tool_ <= options_.tools.size();
  const ProgramTool tool = has_tool ? options_.tools[tool_ - 1] : ProgramTool();
  const OperatorText::Values values{{"tool", fmt::format("{}", tool_)},
                                    {"tool_name", clean(tool.words)},
                                    {"diameter", length(tool.diameter_mm / mm_of(options_.written_unit))},
                                    {"rpm", fmt::format("{}", options_.spindle.value_or(0))},
                                    {"x", length(options_.park_x)},
                                    {"y", length(options_.park_y)},
                                    {"z", length(options_.change_height)},
                                    {"units", name_of(options_.written_unit)},
                                    {"program", clean(options_.program)},
                                    {"seconds", fmt::format("{:g}", options_.spindle_seconds)}};
  for (const std::string& line : text.lines_with(values)) emit(line);
  written_motion_ = -1;
}

// The modes are those of every program; an operator's text may have changed them.
void PostProcessor::Lines::write_modes() {
  add_word('G', "17");
  // There is no word for centimetres.
  if (options_.written_unit == LengthUnit::mm) add_word('G', "21");
  if (options_.written_unit == LengthUnit::inch) add_word('G', "20");
  add_word('G', "40");
  add_word('G', "80");
  add_word('G', "90");
  if (!controller_.knows_all() && controller_.knows_g("91.1")) add_word('G', "91.1");
  add_word('G', "94");
  end_line();
  written_motion_ = -1;
  if (controller_.form.path_mode.empty()) return;
  constexpr double tolerance_mm = 0.01;
  line_ = controller_.form.path_mode;
  if (controller_.form.has_path_tolerance) add_length('P', tolerance_mm / mm_of(options_.written_unit));
  end_line();
}

void PostProcessor::Lines::call_tool(std::uint32_t number) {
  tool_ = number;
  if (!options_.tool_change.empty()) {
    write_operator_text(options_.tool_change);
    write_modes();
    return;
  }
  add_word('T', fmt::format("{}", number));
  if (controller_.tool_call == ToolCall::pause) {
    end_line();
    add_code('M', 0);
  } else {
    add_code('M', 6);
    if (controller_.tool_call == ToolCall::m6_and_length) called_length_ = number;
  }
  end_line();
  written_motion_ = -1;
}

void PostProcessor::Lines::end() {
  write_operator_text(options_.end);
  if (!options_.end.ends_program()) emit(controller_.form.end);
  if (controller_.form.has_frame) text_ += "%\n";
}

void PostProcessor::Lines::write_dwell(double seconds) {
  constexpr double ms = 1000;
  add_code('G', 4);
  add_word('P', controller_.form.dwells_in_ms ? fmt::format("{:.0f}", seconds * ms) : code_number(seconds));
  if (!words_.comment.empty()) line_ += fmt::format(" ({})", clean(words_.comment));
  end_line();
}

void PostProcessor::Lines::write_part(const ProgrammedArc& arc, const ArcPart& part, bool is_first) {
  constexpr std::string_view axes = "XYZ";
  const std::array<double, 3> from = at_;
  add_motion(part.is_arc ? (arc.counterclockwise ? 3 : 2) : 1);
  const auto rounded = [&](double value) { return std::round(value / digit_) * digit_; };
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_of_plane = i == arc.first || i == arc.second;
    if (is_of_plane || length(part.to[i]) != length(from[i])) add_length(axes[i], part.to[i]);
  }
  if (part.is_arc) {
    constexpr std::string_view centres = "IJK";
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == arc.first || i == arc.second) add_length(centres[i], arc.centre[i] - rounded(from[i]));
    }
  }
  if (const ProgramWord* feed = words_.find('F'); feed != nullptr && is_first) {
    add_length('F', is_inverse_time_ ? feed->value : feed->value * scale_);
  }
  if (const ProgramWord* power = words_.find('S'); power != nullptr && is_first) {
    add_word('S', code_number(power->value));
  }
  end_line();
  at_ = part.to;
}

void PostProcessor::Lines::write_arc() {
  ProgrammedArc arc{.from = at_, .to = at_, .centre = at_, .counterclockwise = read_motion_ == 3};
  if (plane_ == 18) arc.first = 2, arc.second = 0;
  if (plane_ == 19) arc.first = 1, arc.second = 2;
  for (const ProgramWord& word : words_.words) {
    if (word.letter >= 'X' && word.letter <= 'Z') arc.to[place_of(word.letter, 'X')] = word.value * scale_;
    if (word.letter >= 'I' && word.letter <= 'K') arc.centre[place_of(word.letter, 'I')] += word.value * scale_;
  }
  if (words_.find('P') != nullptr || words_.find('R') != nullptr) refuse("expected an arc with I, J or K");
  if (words_.has('G', plane_)) {
    add_code('G', plane_);
    end_line();
  }
  if (controller_.knows_all()) {
    write_part(arc, {arc.to, true}, true);
    return;
  }
  const double mm = mm_of(options_.written_unit);
  bool is_first = true;
  for (const ArcPart& part : arc_parts(arc, controller_.arcs, mm, digit_)) {
    write_part(arc, part, is_first);
    is_first = false;
  }
}

// A line with a straight move, a hole of a cycle, or no motion at all.
void PostProcessor::Lines::write_other() {
  const bool is_cycle = read_motion_ == 81 || read_motion_ == 83;
  bool has_axis = false;
  for (const ProgramWord& word : words_.words) has_axis = has_axis || (word.letter >= 'U' && word.letter <= 'Z');
  for (const ProgramWord& word : words_.words) {
    if (word.letter != 'G') continue;
    const bool is_motion = (word.value >= 0 && word.value <= 3) || word.value == 81 || word.value == 83;
    if (!is_motion) add_code('G', word.value);
    if (word.value == 80) written_motion_ = -1;
  }
  if (has_axis) add_motion(read_motion_);
  if (called_length_ != 0 && words_.find('Z') != nullptr) {
    add_code('G', 43);
    add_word('H', fmt::format("{}", std::exchange(called_length_, 0)));
  }
  for (const ProgramWord& word : words_.words) {
    if (word.letter == 'G') continue;
    if (!controller_.knows_letter(word.letter)) {
      refuse(fmt::format("{} has no {}", controller_.title, word.letter));
    }
    const double scaled = word.value * scale_;
    if (word.letter == 'M') {
      add_code('M', word.value);
    } else if (word.letter == 'F') {
      add_length('F', is_inverse_time_ ? word.value : scaled);
    } else if (lengths.find(word.letter) != std::string_view::npos) {
      add_length(word.letter, scaled);
    } else {
      add_word(word.letter, code_number(word.value));
    }
    const bool is_place = word.letter >= 'X' && word.letter <= 'Z' && !(is_cycle && word.letter == 'Z');
    if (is_place) at_[place_of(word.letter, 'X')] = scaled;
  }
  if (!words_.comment.empty()) line_ += fmt::format(" ({})", clean(words_.comment));
  end_line();
}

void PostProcessor::Lines::read(std::string_view line) {
  ++number_;
  begin();
  if (line.empty()) {
    if (controller_.form.line_step == 0) text_ += '\n';
    return;
  }
  read_words(line, words_);
  if (words_.bad_column > 0) refuse(fmt::format("unexpected '{}'", line.substr(words_.bad_column - 1, 1)));
  constexpr double largest = 1e7;
  for (const ProgramWord& word : words_.words) {
    if (std::abs(word.value) <= largest) continue;
    refuse(fmt::format("{}{} is too large", word.letter, word.digits));
    return;
  }
  if (words_.words.empty()) {
    write_comment(words_.comment);
    return;
  }
  for (const ProgramWord& word : words_.words) {
    if (word.letter != 'G') continue;
    const bool is_motion = word.value == 0 || word.value == 1 || word.value == 2 || word.value == 3;
    if (is_motion || word.value == 80 || word.value == 81 || word.value == 83)
      read_motion_ = static_cast<int>(word.value);
    if (word.value == 17 || word.value == 18 || word.value == 19) plane_ = static_cast<int>(word.value);
    if (word.value == 93 || word.value == 94) is_inverse_time_ = word.value == 93;
  }
  if (words_.has('G', 90)) {
    write_operator_text(options_.start);
    write_modes();
  } else if (words_.has('M', 6)) {
    const ProgramWord* const tool = words_.find('T');
    const bool is_good = tool != nullptr && tool->value >= 0 && tool->value == std::floor(tool->value);
    if (!is_good) refuse("expected T with a tool number");
    call_tool(is_good ? static_cast<std::uint32_t>(tool->value) : 0);
  } else if (words_.has('M', 2)) {
    end();
  } else if (words_.has('G', 4)) {
    write_dwell(words_.find('P') == nullptr ? 0 : words_.find('P')->value);
  } else if (read_motion_ == 2 || read_motion_ == 3) {
    move();
  } else {
    write_other();
  }
}

// A line without a position is not a move in any mode.
void PostProcessor::Lines::move() {
  const bool has_centre = words_.find('I') != nullptr || words_.find('J') != nullptr || words_.find('K') != nullptr;
  if (has_centre) {
    write_arc();
  } else {
    write_other();
  }
}

std::optional<std::string> PostProcessor::Lines::finish() {
  flush();
  if (error_.empty()) return std::nullopt;
  return error_;
}

PostProcessor::PostProcessor(const ControllerWords& controller, PostProcessorOptions options, Sink sink)
    : lines_(std::make_unique<Lines>(controller, std::move(options), std::move(sink))) {}

PostProcessor::~PostProcessor() = default;

void PostProcessor::add(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) {
      rest_ += text;
      return;
    }
    if (rest_.empty()) {
      lines_->read(text.substr(0, end));
    } else {
      rest_ += text.substr(0, end);
      lines_->read(rest_);
      rest_.clear();
    }
    text.remove_prefix(end + 1);
  }
}

std::optional<std::string> PostProcessor::finish() {
  if (!rest_.empty()) lines_->read(rest_);
  rest_.clear();
  return lines_->finish();
}

}  // namespace passo
