#include "grbl_dialect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

#include "passo/gcode/expression.hpp"
#include "passo/gcode/grbl_command.hpp"
#include "passo/interpreter/grbl_errors.hpp"

namespace passo {
namespace {

constexpr LetterSet accepted_letters = "FGIJKLMNPRSTXYZ";
constexpr LetterSet never_negative = "FNPST";
constexpr LetterSet grbl_axes = "XYZ";

constexpr std::size_t longest_grbl_line = 79;  // a buffer of 80, without blanks and comments
constexpr double highest_grbl_tool = 255;
constexpr double highest_line_number = 10'000'000;
constexpr double work_systems = 6;

// grbl's errors. The numbers that are missing are of grbl's settings and states, and never of a program.
struct Error {
  int number;
  std::string_view code;  // of grbl's own checks
  std::string_view what;
};
constexpr Error errors[] = {
    {1, "grbl.expected-letter", "expected a command letter"},
    {2, "grbl.bad-number", "bad number format"},
    {3, "grbl.system-command", "invalid $ system command"},
    {4, "grbl.negative-value", "negative value"},
    {11, "grbl.line-overflow", "line overflow"},
    {20, "grbl.unsupported-command", "unsupported or invalid command"},
    {21, "grbl.modal-group-violation", "modal group violation"},
    {22, "grbl.undefined-feed", "undefined feed rate"},
    {23, "grbl.not-integer", "command value is not an integer"},
    {24, "grbl.axis-command-conflict", "two commands use the axis words"},
    {25, "grbl.word-repeated", "a word is repeated"},
    {26, "grbl.no-axis-words", "no axis words"},
    {27, "grbl.bad-line-number", "invalid line number"},
    {28, "grbl.missing-word", "a value word is missing"},
    {29, "grbl.unsupported-coordinate-system", "unsupported work coordinate system"},
    {30, "grbl.g53-motion", "G53 allows G0 and G1 only"},
    {31, "grbl.axis-words-exist", "axis words that no command uses"},
    {32, "grbl.no-axis-words-in-plane", "no axis words in the plane"},
    {33, "grbl.invalid-target", "invalid target"},
    {34, "grbl.arc-radius", "arc radius"},
    {35, "grbl.no-offsets-in-plane", "no arc offsets in the plane"},
    {36, "grbl.unused-words", "unused value words"},
    {37, "grbl.tool-length-axis", "tool length offset is for one axis only"},
    {38, "grbl.highest-tool", "tool number above the maximum"},
};

// grbl's number for an error that the interpreter itself finds.
struct Translation {
  std::string_view code;
  int number;
};
constexpr Translation translations[] = {
    {"gcode.unexpected-text", 1},   {"gcode.bad-character", 1},       {"gcode.unknown-word", 1},
    {"gcode.missing-value", 2},     {"gcode.number-out-of-range", 2}, {"gcode.negative-word", 4},
    {"gcode.line-too-long", 11},    {"gcode.unknown-code", 20},       {"gcode.modal-conflict", 21},
    {"gcode.missing-feed", 22},     {"gcode.not-whole", 23},          {"gcode.axis-conflict", 24},
    {"gcode.ambiguous-word", 36},   {"gcode.repeated-word", 25},      {"gcode.missing-axis", 26},
    {"gcode.missing-word", 28},     {"gcode.g53-without-move", 30},   {"gcode.missing-motion", 31},
    {"gcode.arc-radii-differ", 33}, {"gcode.zero-arc", 33},           {"gcode.impossible-arc", 34},
    {"gcode.missing-center", 35},   {"gcode.unused-word", 36},        {"gcode.probe-too-short", 33},
    {"gcode.grbl-command", 3},
};

const Error& error_of(int number) {
  return *std::ranges::find(errors, number, &Error::number);
}

GrblUse use_of(char letter, CodeNumber number) {
  const CodeEntry* const entry = find_code(letter, number);
  return entry == nullptr ? GrblUse::refused : entry->grbl;
}
bool is_known(char letter, CodeNumber number) {
  return use_of(letter, number) != GrblUse::refused;
}

// Checks one block as grbl would.
class GrblCheck {
 public:
  GrblCheck(const Block& block, const ProgramState& state, Reporter& reporter, LetterSet more_axes)
      : block_(block), state_(state), reporter_(reporter), axes_(grbl_axes | more_axes) {}

  bool passes() {
    if (!lines_shape()) return false;
    for (const Word& word : block_.words) {
      if (!take(word)) return false;
    }
    return words_suffice();
  }

  // For a line that cannot be read to its end. True: grbl finds something else before, which is reported.
  bool refuses_before_fault() {
    if (is_system_command()) {
      const std::optional<GrblCommand> command = grbl_command_in(block_.text);
      return !fail(3, {1, 1}, command ? command->message : "a line with $ is a system command of Grbl, not G-code",
                   command ? command->expected : "a program without system commands; the sender sends them");
    }
    for (const Word& word : block_.words) {
      if (is_no_letter(word)) return !take(word);
      if (word.value.count == 0) return false;  // here reading ended
      if (!take(word)) return true;
    }
    return false;
  }

  // Words that grbl passes over: those of I J K outside the plane of an arc, and axis words beside G49.
  LetterSet idle_letters() const { return idle_letters_; }

 private:
  bool fail(int number, Span span, FindingWords message, FindingWords expected) {
    reporter_.error(error_of(number).code, span, std::move(message), std::move(expected));
    return false;
  }

  bool is_system_command() const {
    const std::size_t first = block_.text.find_first_not_of(" \t");
    return first != std::string_view::npos && block_.text[first] == '$';
  }

  bool lines_shape() {
    if (is_system_command()) return !refuses_before_fault();
    if (block_.percent) return fail(1, {1, 1}, "Grbl does not support '%'", "no '%'; senders remove it");
    std::size_t length = 0;
    std::size_t comment_at = 0;
    for (std::size_t i = 0; i < block_.text.size(); ++i) {
      while (comment_at < block_.comments.size() && i >= end_of(block_.comments[comment_at].span)) ++comment_at;
      const bool in_comment = comment_at < block_.comments.size() && i + 1 >= block_.comments[comment_at].span.column;
      const char c = block_.text[i];
      if (!in_comment && c > ' ' && c != '/' && ++length > longest_grbl_line) {
        return fail(11, {static_cast<std::uint32_t>(i + 1), 1}, "the line is too long for Grbl",
                    fmt::format("at most {} characters, not counting spaces and comments", longest_grbl_line));
      }
    }
    if (block_.control)
      return fail(20, block_.control->span, "Grbl does not support O-words", "a program without O-words");
    if (!block_.assignments.empty()) {
      return fail(1, block_.assignments.front().span, "Grbl does not support parameters", "a program without O-words");
    }
    return true;
  }
  static std::size_t end_of(Span span) { return std::size_t{span.column} - 1 + span.length; }
  double line_number() const {
    double number = 0;
    for (const char digit : *block_.line_number) {
      if (digit < '0' || digit > '9') break;
      number = number * 10 + (digit - '0');
    }
    return number;
  }

  static bool is_no_letter(const Word& word) { return word.letter == '@' || word.letter == '^' || word.letter == '$'; }
  bool take(const Word& word) {
    if (is_no_letter(word)) {
      return fail(1, word.span, fmt::format("Grbl does not support {}", word.letter), "letters");
    }
    const Instruction& value = block_.code[word.value.first];
    const std::string_view text = block_.text.substr(word.span.column - 1, word.span.length);
    if (word.value.count != 1 || value.op != ExpressionOp::number || text.find('[') != std::string_view::npos) {
      return fail(2, word.span, "Grbl does not support parameters and expressions", "a number");
    }
    const auto is_sign = [](char c) { return c == '-' || c == '+'; };
    if (std::ranges::count_if(text, is_sign) > 1)
      return fail(2, word.span, "Grbl accepts only one sign before a number", "a number");
    if (!(accepted_letters | axes_).has(word.letter)) {
      return fail(20, word.span, fmt::format("Grbl does not support the word {}", word.letter),
                  "F I J K L N P R S T X Y Z");
    }
    if (word.letter == 'G' || word.letter == 'M') return take_code(word, value.number);
    return take_value(word, value.number);
  }

  // grbl keeps the whole part in a byte, and what is left in hundredths.
  bool take_code(const Word& word, double value) {
    const int whole = static_cast<std::uint8_t>(static_cast<int>(std::fmod(value, 256)));
    const double hundredths = whole == 49 ? 0 : std::round(100 * (value - whole));
    const bool claims = word.letter == 'G' && claims_axes(whole, hundredths);
    if (claims && axis_user_ != nullptr) {
      return fail(24, word.span,
                  fmt::format("{} and G{} both use the axis words", spelling(*axis_user_), plain_number(value)),
                  interpreter_says::two_blocks);
    }
    const bool readable = hundredths >= 0 && hundredths < 100 && std::fmod(hundredths, 10) == 0;
    const CodeNumber number = readable ? code(whole, static_cast<int>(hundredths / 10)) : CodeNumber{-1};
    const bool changes_tool = state_.measured.by_plan && word.letter == 'M' && number == code(6);
    if (!changes_tool && !is_known(word.letter, number)) {
      // G54.1 is a G54 with too many digits, and G64 is an unknown code.
      const bool whole_known = is_known(word.letter, code(whole));
      const bool digits_too_many = hundredths != 0 && (word.letter == 'M' || (whole_known && !has_fractions(whole)));
      return fail(digits_too_many ? 23 : 20, word.span,
                  fmt::format("Grbl does not support {}{}", word.letter, plain_number(value)),
                  "a code of Grbl 1.1, listed in docs/gcode.md");
    }
    const CodeEntry* const entry = find_code(word.letter, number);
    const std::size_t group = index_of(entry->group);
    if (claims) {
      axis_user_ = entry;
      code_span_ = word.span;
    }
    if (codes_[group] != nullptr) {
      return fail(21, word.span,
                  fmt::format("{} and {} are in the same group ({})", spelling(*codes_[group]), spelling(*entry),
                              row_of(entry->group).name),
                  interpreter_says::one_or_two_blocks);
    }
    codes_[group] = entry;
    return true;
  }
  // Which code takes the axis words is what grbl looks at first, before the digits behind the point. G49 counts, though
  // it uses none.
  static bool claims_axes(int whole, double hundredths) {
    if (whole == 10 || whole == 28 || whole == 30 || whole == 92) return hundredths == 0;
    return whole <= 3 || whole == 38 || whole == 43 || whole == 49;
  }
  // G codes where grbl expects digits behind the point.
  static bool has_fractions(int whole) {
    return whole == 28 || whole == 30 || whole == 38 || whole == 43 || whole == 61 || whole == 90 || whole == 91 ||
           whole == 92;
  }

  bool take_value(const Word& word, double value) {
    if (word.letter == 'T' && value > highest_grbl_tool) {
      return fail(38, word.span, fmt::format("tool {} is above Grbl's highest tool number", plain_number(value)),
                  "T255 at most");
    }
    if (has(word.letter)) {
      return fail(25, word.span, interpreter_says::second_letter.with({{"letter", std::string(1, word.letter)}}),
                  "each letter once");
    }
    if (never_negative.has(word.letter) && value < 0) {
      return fail(4, word.span, fmt::format("{} is {}", word.letter, plain_number(value)), "0 or more");
    }
    present_.add(word.letter);
    values_[letter_index(word.letter)] = value;
    spans_[letter_index(word.letter)] = word.span;
    return true;
  }
  bool has(char letter) const { return present_.has(letter); }
  double value(char letter) const { return values_[letter_index(letter)]; }
  Span span(char letter) const { return spans_[letter_index(letter)]; }
  bool any_axis() const { return (present_ & axes_).any(); }

  bool uses_axes(const CodeEntry* entry) const { return entry != nullptr && entry->axes != AxisUse::none; }

  const CodeEntry* code_of(ModalGroup group) const { return codes_[index_of(group)]; }
  bool uses_axes(ModalGroup group) const {
    const CodeEntry* const entry = code_of(group);
    return entry != nullptr && entry->axes != AxisUse::none;
  }

  // In grbl's order. Words without use come last of all: BlockExecutor finds them.
  bool words_suffice() {
    if (block_.line_number && line_number() > highest_line_number) {
      return fail(27, {1, 1}, fmt::format("the line number N{} is too large for Grbl", *block_.line_number),
                  "N10000000 at most");
    }
    const CodeNumber motion = motion_of_block();
    if (is_inverse_time() && moves() && needs_feed(motion) && !has('F')) return fail_feed();
    const CodeEntry* const non_modal = code_of(ModalGroup::non_modal);
    if (non_modal != nullptr && non_modal->number == code(4) && !has('P')) {
      return fail(28, word_span('G', code(4)), interpreter_says::dwell_without_p, interpreter_says::seconds_to_wait);
    }
    const CodeEntry* const tool_length = code_of(ModalGroup::tool_length);
    if (tool_length != nullptr && tool_length->number == code(43, 1) &&
        (present_ & axes_).bits() != LetterSet("Z").bits()) {
      return fail(37, code_span_, "in Grbl, G43.1 offsets the Z axis only", "Z, and no other axis word");
    }
    if (non_modal != nullptr && non_modal->number == code(10) && !g10_suffices()) return false;
    if (non_modal != nullptr && non_modal->number == code(92) && !any_axis()) {
      return fail(26, code_span_, interpreter_says::without_axes.with({{"code", "G92"}}), "X, Y or Z");
    }
    if (non_modal != nullptr && non_modal->number == code(53) && motion != code(0) && motion != code(1)) {
      return fail(30, word_span('G', code(53)), "G53 without G0 or G1", "G53 G0 … or G53 G1 …");
    }
    if (motion == code(80) && any_axis()) {
      return fail(31, first_axis_span(), "axis words while G80 is active, so nothing moves", "G0, G1, G2 or G3");
    }
    if (tool_length != nullptr && tool_length->axes == AxisUse::none) idle_letters_ = axes_;
    if (uses_axes(ModalGroup::non_modal) || tool_length != nullptr) return true;
    if (moves() && needs_feed(motion) && !has_feed()) return fail_feed();
    return arc_suffices(motion);
  }

  CodeNumber motion_of_block() const {
    const CodeEntry* const written = code_of(ModalGroup::motion);
    return written != nullptr ? written->number : state_.modal[ModalGroup::motion];
  }
  // True: a motion takes the block's axis words, or was written without any.
  bool moves() const {
    if (code_of(ModalGroup::motion) != nullptr) return true;
    return any_axis() && !uses_axes(ModalGroup::non_modal) && code_of(ModalGroup::tool_length) == nullptr;
  }
  static bool needs_feed(CodeNumber motion) { return motion != code(0) && motion != code(80); }
  bool is_inverse_time() const {
    const CodeEntry* const mode = code_of(ModalGroup::feed_mode);
    return (mode != nullptr ? mode->number : state_.modal[ModalGroup::feed_mode]) == code(93);
  }
  bool has_feed() const {
    if (has('F')) return value('F') > 0;
    return !is_inverse_time() && !state_.modal.inverse_time() && state_.feed > 0;
  }
  bool fail_feed() {
    const Span at = code_of(ModalGroup::motion) != nullptr ? code_span_ : first_axis_span();
    return fail(22, at, interpreter_says::no_feed,
                is_inverse_time() ? "F in each block that feeds (G93)" : "F in this block or earlier");
  }
  Span word_span(char letter, CodeNumber number) const {
    for (const Word& word : block_.words) {
      if (word.letter == letter && std::lround(block_.code[word.value.first].number * 10) == number) return word.span;
    }
    return {1, 1};
  }

  bool g10_suffices() {
    if (!any_axis()) return fail(26, code_span_, interpreter_says::without_axes.with({{"code", "G10"}}), "X, Y or Z");
    if (!has('P') && !has('L')) return fail(28, code_span_, "G10 needs L", "L2 or L20, and P0 to P6");
    const double kind = std::trunc(value('L'));
    if (value('P') >= work_systems + 1) return fail(29, span('P'), "Grbl has six work offsets", "P0 to P6");
    if (kind != 2 && kind != 20) {
      return fail(20, has('L') ? span('L') : code_span_, "Grbl supports G10 L2 and L20 only", "L2 or L20");
    }
    if (kind == 2 && has('R')) return fail(20, span('R'), "Grbl cannot rotate work offsets", "no R");
    return true;
  }

  // In grbl an arc needs an axis word of its plane. LinuxCNC takes the centre alone as a full circle.
  bool arc_suffices(CodeNumber motion) {
    const CodeEntry* const written = code_of(ModalGroup::motion);
    if (motion != code(2) && motion != code(3)) return true;
    if (written == nullptr && !any_axis()) return true;
    const Span at = written != nullptr ? code_span_ : block_.words.front().span;
    if (!any_axis()) return fail(26, at, "an arc without axis words", "the end of the arc");
    const CodeEntry* const new_plane = code_of(ModalGroup::plane);
    const CodeNumber plane = new_plane != nullptr ? new_plane->number : state_.modal[ModalGroup::plane];
    const LetterSet in_plane = plane == code(17) ? "XY" : plane == code(18) ? "XZ" : "YZ";
    const LetterSet offsets = plane == code(17) ? "IJ" : plane == code(18) ? "IK" : "JK";
    if (!(present_ & in_plane).any()) return fail(32, at, "no axis word of the arc's plane", "at least one");
    if (!has('R') && !(present_ & offsets).any()) {
      return fail(35, at, "no centre in the arc's plane", "R, or those of I J K that are in the plane");
    }
    if (!has('R')) idle_letters_ = LetterSet("IJK") - offsets;
    return true;
  }
  Span first_axis_span() const {
    for (const char letter : std::string_view("XYZABCUVW")) {
      if (has(letter)) return span(letter);
    }
    return {1, 1};
  }

  const Block& block_;
  const ProgramState& state_;
  Reporter& reporter_;
  LetterSet axes_;
  LetterSet present_;
  LetterSet idle_letters_;
  std::array<double, letter_count> values_{};
  std::array<Span, letter_count> spans_{};
  std::array<const CodeEntry*, modal_group_count> codes_{};
  const CodeEntry* axis_user_ = nullptr;  // the code that may use the axis words
  Span code_span_{1, 1};                  // its place
};

bool is_without_effect(const Block& block, const Word& word) {
  if (word.letter != 'G' && word.letter != 'M') return false;
  const double value = block.code[word.value.first].number;
  return use_of(word.letter, static_cast<CodeNumber>(std::lround(value * 10))) == GrblUse::without_effect;
}

// Of T, L and P of G10, grbl takes the whole part; of G and M the digits that it has looked at.
void drop_decimals(Block& block) {
  const auto number_of = [&block](const Word& word) -> double& { return block.code[word.value.first].number; };
  const bool sets_offset = std::ranges::any_of(block.words, [&](const Word& word) {
    return word.letter == 'G' && std::lround(number_of(word) * 10) == code(10);
  });
  for (const Word& word : block.words) {
    double& number = number_of(word);
    if (word.letter == 'T' || word.letter == 'L' || (word.letter == 'P' && sets_offset)) number = std::trunc(number);
    if (word.letter == 'G' || word.letter == 'M') {
      number = std::trunc(number) == 49 ? 49 : std::round(number * 10) / 10;
    }
  }
}

}  // namespace

bool refuse_as_grbl(const Block& block, const ProgramState& state, Reporter& reporter, LetterSet more_axes) {
  return GrblCheck(block, state, reporter, more_axes).refuses_before_fault();
}

bool accept_as_grbl(Block& block, const ProgramState& state, Reporter& reporter, LetterSet more_axes) {
  GrblCheck check(block, state, reporter, more_axes);
  if (!check.passes()) return false;
  drop_decimals(block);
  std::erase_if(block.words, [&](const Word& word) {
    const bool idle = word.letter != 'G' && word.letter != 'M' && check.idle_letters().has(word.letter);
    return idle || is_without_effect(block, word);
  });
  // As grblHAL does, messages reach the operator. grbl itself obeys no comment.
  for (BlockComment& comment : block.comments) {
    if (comment.kind != BlockComment::Kind::message) comment.kind = BlockComment::Kind::plain;
  }
  return true;
}

std::optional<int> grbl_error_number(std::string_view code) {
  for (const Translation& line : translations) {
    if (line.code == code) return line.number;
  }
  for (const Error& error : errors) {
    if (error.code == code) return error.number;
  }
  return {};
}

std::string grbl_error(std::string_view code) {
  const auto number = grbl_error_number(code);
  return number ? fmt::format("grbl error:{}, {}", *number, error_of(*number).what) : std::string();
}

}  // namespace passo
