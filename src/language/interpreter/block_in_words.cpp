#include "block_in_words.hpp"

#include <cmath>

#include "reporter.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

std::string rounded(double value) {
  return plain_number(std::round(value * 1e6) / 1e6 + 0.0);
}

std::string quantity_in_words(double value, LetterQuantity quantity, const ProgramState& state) {
  switch (quantity) {
    case LetterQuantity::length:
      return state.modal.inches() ? fmt::format("{} in ({} mm)", plain_number(value), rounded(value * mm_per_inch))
                                  : fmt::format("{} mm", plain_number(value));
    case LetterQuantity::turns: return number_and_noun(value, "turn");
    case LetterQuantity::times: return number_and_noun(value, "time");
    case LetterQuantity::degrees: return number_and_noun(value, "degree");
    case LetterQuantity::seconds: return fmt::format("{} s", plain_number(value));
    case LetterQuantity::speed: return fmt::format("{} rev/min", plain_number(value));
    default: return plain_number(value);
  }
}

std::string on_axis(double millimetres_or_degrees, Axis axis) {
  const double value = std::round(millimetres_or_degrees * 1e6) / 1e6 + 0.0;
  return is_rotary(axis) ? number_and_noun(value, "degree") : plain_number(value) + " mm";
}

// The words of one block, and their meanings with its codes.
class Meanings {
 public:
  Meanings(const std::vector<WordValue>& words, const ProgramState& before, const ProgramState& after) : after_(after) {
    bool any_axis = false;
    for (const WordValue& word : words) {
      any_axis |= word.letter != 0 && (axis_letters | polar_letters).has(word.letter);
      if (const CodeEntry* const entry = code_of(word)) codes_.push_back(entry);
    }
    for (const CodeEntry* entry : codes_) {
      // A block may have two codes, as G53 and its move, or a motion and a code that only sets. The one that uses the
      // axis words takes them.
      if (entry->axes != AxisUse::none && (taker_ == nullptr || entry->group != ModalGroup::motion)) taker_ = entry;
      machine_ = machine_ || (entry->letter == 'G' && entry->number == code(53));
    }
    if (taker_ != nullptr) return;
    implied_ = find_code('G', before.modal[ModalGroup::motion]);
    if (implied_ == nullptr || !(any_axis || is_arc(*implied_))) return;
    taker_ = implied_;
    codes_.push_back(implied_);
  }

  // The active motion, if it takes the words of the block. Null: it does not.
  const CodeEntry* implied_motion() const { return taker_ == implied_ ? implied_ : nullptr; }

  std::string of(const WordValue& word) const {
    if (word.letter == 0) return word.meaning;
    if (!word.known) return "has no value";
    switch (word.letter) {
      case 'G':
      case 'M': return of_code(word);
      case 'F': return of_feed(word.value);
      case 'S':
        return after_.modal[ModalGroup::spindle_mode] == code(96)
                   ? fmt::format("surface speed {} {}", plain_number(word.value),
                                 after_.modal.inches() ? "feet/min" : "m/min")
                   : fmt::format("spindle speed {} rev/min", plain_number(word.value));
      case 'T': return fmt::format("select tool {}", plain_number(word.value));
      case '@': return "distance from the origin " + quantity_in_words(word.value, LetterQuantity::length, after_);
      case '^': return "direction " + quantity_in_words(word.value, LetterQuantity::degrees, after_);
      default: break;
    }
    const auto axis = axis_of(word.letter);
    return axis ? of_axis(*axis, word.value) : of_letter(word.letter, word.value);
  }

 private:
  static const CodeEntry* code_of(const WordValue& word) {
    if ((word.letter != 'G' && word.letter != 'M') || !word.known || !(std::abs(word.value) < 1000)) return nullptr;
    return find_code(word.letter, static_cast<CodeNumber>(std::lround(word.value * 10)));
  }
  static bool is_arc(const CodeEntry& entry) {
    return entry.letter == 'G' && (entry.number == code(2) || entry.number == code(3));
  }

  static std::string of_code(const WordValue& word) {
    const CodeEntry* const entry = code_of(word);
    if (entry == nullptr) return "not a code of this dialect";
    return std::string(entry->what);
  }

  std::string of_feed(double value) const {
    if (after_.modal.inverse_time()) return fmt::format("the move takes 1/{} minute", plain_number(value));
    return fmt::format("feed {} {}{}", plain_number(value), after_.modal.inches() ? "inches" : "mm",
                       after_.modal.per_revolution() ? "/rev" : "/min");
  }

  // Straight moves and arcs end at their axis words. A cycle uses them in its own way.
  static bool goes_to_its_words(const CodeEntry& entry) {
    return entry.letter == 'G' && entry.group == ModalGroup::motion && entry.number < code(70);
  }

  std::string of_axis(Axis axis, double value) const {
    const std::string given = fmt::format(
        "{} {}", letter_of(axis),
        quantity_in_words(value, is_rotary(axis) ? LetterQuantity::degrees : LetterQuantity::length, after_));
    if (taker_ == nullptr) return given + ", which no code uses";
    if (taker_->group == ModalGroup::tool_length) return "tool offset " + given;
    if (goes_to_its_words(*taker_)) {
      const std::string machine = on_axis(after_.machine_position()[axis], axis) + " (machine)";
      if (machine_) return fmt::format("to {} {}", letter_of(axis), machine);
      const std::string target =
          fmt::format("to {} {} (work), {}", letter_of(axis), on_axis(after_.position[axis], axis), machine);
      return after_.modal.incremental() ? fmt::format("by {}, {}", given, target) : target;
    }
    switch (taker_->number) {
      case code(10): return "set " + given;
      case code(28):
      case code(30):
        return fmt::format("this axis moves home through {}{}", after_.modal.incremental() ? "+" : "", given);
      case code(52): return "shift all work offsets by " + given;
      case code(92): return "this position is " + given + " from now on";
      default: return given;
    }
  }

  std::string of_letter(char letter, double value) const {
    for (const CodeEntry* entry : codes_) {
      if (!entry->letters.has(letter)) continue;
      if (is_arc(*entry) && letter >= 'I' && letter <= 'K') return of_center(letter, value);
      if (entry->letter == 'G' && entry->number == code(10) && letter == 'L') return what_g10_sets(value);
      for (const LetterMeaning& meaning : entry->meanings) {
        if (meaning.letter != letter) continue;
        return fmt::format(fmt::runtime(meaning.text), quantity_in_words(value, meaning.quantity, after_));
      }
      return fmt::format("a value of {}: {}", spelling(*entry), plain_number(value));
    }
    return "used by no code of the block";
  }

  static std::string what_g10_sets(double kind) {
    if (kind == 2) return "set the origin of a work offset";
    if (kind == 20) return "set a work offset so that the current position gets these coordinates";
    return fmt::format("set an entry of the tool table, kind {}", plain_number(kind));
  }

  std::string of_center(char letter, double value) const {
    const char axis = static_cast<char>('X' + (letter - 'I'));
    const std::string length = quantity_in_words(value, LetterQuantity::length, after_);
    return after_.modal[ModalGroup::arc_distance] == code(90, 1)
               ? fmt::format("the arc's centre is at {} {}", axis, length)
               : fmt::format("the arc's centre is {} in {} from its start", length, axis);
  }

  const ProgramState& after_;
  std::vector<const CodeEntry*> codes_;
  const CodeEntry* taker_ = nullptr;    // the code that takes the axis words
  const CodeEntry* implied_ = nullptr;  // the active motion, if no code of the block takes the axis words
  bool machine_ = false;                // G53
};

std::string_view text_of(const Block& block, Span span) {
  if (span.column == 0 || span.column > block.text.size()) return {};
  return block.text.substr(span.column - 1, span.length);
}

const char* meaning_of(BlockComment::Kind kind) {
  using Kind = BlockComment::Kind;
  switch (kind) {
    case Kind::message: return "a message to the operator";
    case Kind::debug: return "a message to the operator, with the values of parameters";
    case Kind::print: return "printed, with the values of parameters";
    case Kind::log: return "a line for the log file";
    case Kind::log_open:
    case Kind::log_append: return "opens the log file";
    case Kind::log_close: return "closes the log file";
    case Kind::abort: return "the program aborts";
    case Kind::probe_open: return "opens the file for probe results";
    case Kind::probe_close: return "closes the file for probe results";
    default: return "a comment";
  }
}

const char* meaning_of(ControlKind kind) {
  switch (kind) {
    case ControlKind::sub: return "start of a subroutine, which is skipped until it is called";
    case ControlKind::endsub: return "end of the subroutine: return to the caller";
    case ControlKind::call: return "call of a subroutine";
    case ControlKind::return_: return "return from the subroutine to the caller";
    case ControlKind::do_: return "start of a loop that tests its condition at the end";
    case ControlKind::while_: return "a loop that repeats while the value is not 0";
    case ControlKind::endwhile: return "end of the loop: test the condition again";
    case ControlKind::if_: return "only if the value is not 0";
    case ControlKind::elseif: return "otherwise, only if the value is not 0";
    case ControlKind::else_: return "else";
    case ControlKind::endif: return "end of the if";
    case ControlKind::repeat: return "a loop with this number of passes";
    case ControlKind::endrepeat: return "end of the loop: next pass";
    case ControlKind::break_: return "leave the loop";
    case ControlKind::continue_: return "continue with the next pass of the loop";
    default: return "a numbered program";
  }
}

}  // namespace

std::vector<WordValue> word_values(const Block& block, const Parameters& parameters, const SymbolTable& symbols) {
  std::vector<WordValue> values;
  const auto value_of = [&](const Expression& expression) { return evaluate(block, expression, parameters); };
  if (block.block_delete) values.push_back({"/", 0, 0, true, "skipped when block delete is on"});
  if (block.percent) values.push_back({"%", 0, 0, true, "begins or ends the program"});
  if (block.line_number) values.push_back({fmt::format("N{}", *block.line_number), 0, 0, true, "the line's number"});
  for (const Word& word : block.words) {
    const Evaluation value = value_of(word.value);
    values.push_back(
        {std::string(text_of(block, word.span)), word.letter, value ? *value : 0, static_cast<bool>(value), {}});
  }
  for (const Assignment& assignment : block.assignments) {
    const Evaluation value = value_of(assignment.value);
    std::string name = fmt::format("<{}>", symbols.name(assignment.symbol));
    if (assignment.index) {
      const Evaluation index = value_of(*assignment.index);
      name = index ? plain_number(*index) : std::string("?");
    }
    values.push_back({std::string(text_of(block, assignment.span)), 0, 0, true,
                      value ? fmt::format("parameter #{} is set to {}", name, plain_number(*value))
                            : fmt::format("parameter #{}: no value", name)});
  }
  if (block.control) {
    std::string meaning = meaning_of(block.control->kind);
    for (std::size_t i = 0; i < block.control->arguments.size(); ++i) {
      const Evaluation value = value_of(block.control->arguments[i]);
      meaning += fmt::format("{}{}", i == 0 ? ": " : ", ", value ? plain_number(*value) : std::string("no value"));
    }
    values.push_back({std::string(text_of(block, block.control->span)), 0, 0, true, std::move(meaning)});
  }
  for (const BlockComment& comment : block.comments) {
    values.push_back({std::string(text_of(block, comment.span)), 0, 0, true, meaning_of(comment.kind)});
  }
  return values;
}

std::vector<Explanation::Word> words_in_words(const std::vector<WordValue>& words, const ProgramState& before,
                                              const ProgramState& after) {
  const Meanings meanings(words, before, after);
  std::vector<Explanation::Word> said;
  if (const CodeEntry* const implied = meanings.implied_motion()) {
    said.push_back({fmt::format("({})", spelling(*implied)), fmt::format("{}, still active", implied->what)});
  }
  for (const WordValue& word : words) said.push_back({word.word, meanings.of(word)});
  return said;
}

}  // namespace passo
