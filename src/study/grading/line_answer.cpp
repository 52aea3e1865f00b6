#include "passo/grading/line_answer.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

constexpr std::size_t few_lines = 2;  // a prompt may look like a position

bool is_letter(char letter) {
  return std::isalpha(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}
bool is_digit(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0;
}

// The end of a name before "=" or ":" that begins here ("x=", "m1: ", "pulse 3:"), or nothing.
std::optional<std::size_t> end_of_label(std::string_view line, std::size_t at) {
  if (!is_letter(line[at]) || (at > 0 && (is_letter(line[at - 1]) || is_digit(line[at - 1])))) return {};
  const auto skip = [&](auto&& wanted) {
    while (at < line.size() && wanted(line[at])) ++at;
  };
  const auto is_blank = [](char letter) { return letter == ' ' || letter == '\t'; };
  skip(is_letter);
  skip(is_blank);
  skip(is_digit);
  skip(is_blank);
  if (at >= line.size() || (line[at] != '=' && line[at] != ':')) return {};
  return at + 1;
}

// The numbers at the end of a line, in its order.
std::vector<double> last_numbers(std::string_view line) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < line.size();) {
    if (const auto end = end_of_label(line, at)) {
      at = *end;
      continue;
    }
    const bool after_number = at > 0 && is_digit(line[at - 1]);
    const bool signs =
        (line[at] == '-' || line[at] == '+') && !after_number && at + 1 < line.size() && is_digit(line[at + 1]);
    if (is_digit(line[at]) || signs) {
      const std::size_t begin = line[at] == '+' ? at + 1 : at;
      double number = 0;
      const auto [end, error] = std::from_chars(line.data() + begin, line.data() + line.size(), number);
      numbers.push_back(error == std::errc() ? number : 1e300);
      at = static_cast<std::size_t>(end - line.data());
      continue;
    }
    // Words end a list of numbers; punctuation and the bytes of other alphabets' signs separate it.
    if (is_letter(line[at])) numbers.clear();
    ++at;
  }
  return numbers;
}

bool equals(const PrintedPosition& printed, const StepCounts& steps) {
  return std::ranges::equal(printed, steps,
                            [](double one, std::int64_t other) { return one == static_cast<double>(other); });
}

std::string position_words(const PrintedPosition& position) {
  return fmt::format("{:.15g}", fmt::join(position, " "));
}

// The same number of the definition, before it is rounded, of the first motor that differs.
std::string exact_words(const StepCounts& steps, std::size_t pulse, const StepCounts& expected,
                        const PrintedPosition& found) {
  std::int64_t longest = 0;
  for (const std::int64_t one : steps) longest = std::max(longest, std::abs(one));
  for (std::size_t motor = 0; motor < steps.size(); ++motor) {
    if (found[motor] == static_cast<double>(expected[motor])) continue;
    if (std::abs(steps[motor]) == longest) return fmt::format("; motor {} is a master and steps every time", motor + 1);
    const double exact = static_cast<double>(steps[motor]) * static_cast<double>(pulse) / static_cast<double>(longest);
    return fmt::format("; motor {}: {} * {} / {} = {:.6g}", motor + 1, pulse, steps[motor], longest, exact);
  }
  return "";
}

std::size_t equal_pulses(std::span<const PrintedPosition> printed, const std::vector<StepCounts>& expected) {
  std::size_t pulse = 0;
  while (pulse < printed.size() && pulse < expected.size() && equals(printed[pulse], expected[pulse])) ++pulse;
  return pulse;
}

// Without the start, which the definition does not print.
std::span<const PrintedPosition> after_start(std::span<const PrintedPosition> printed) {
  if (printed.empty() || std::ranges::any_of(printed[0], [](double steps) { return steps != 0; })) return printed;
  return printed.subspan(1);
}

AnswerFault fault_at(const LineCase& asked, std::span<const PrintedPosition> printed,
                     const std::vector<StepCounts>& expected, std::size_t right) {
  AnswerFault fault{.pulse = static_cast<std::int64_t>(right) + 1, .expected = {}, .found = {}, .words = {}};
  const std::string move = describe_steps(asked.steps);
  if (right < expected.size()) fault.expected = fmt::format("{}", fmt::join(expected[right], " "));
  if (right < printed.size()) fault.found = position_words(printed[right]);
  if (printed.empty()) {
    fault.words = fmt::format("move {}: no positions found in its output", move);
  } else if (fault.found.empty()) {
    fault.words = fmt::format("move {}: ends after pulse {} of {}", move, right, expected.size());
  } else if (fault.expected.empty()) {
    fault.words = fmt::format("move {}: goes on after its {} pulses with {}", move, expected.size(), fault.found);
  } else {
    fault.words = fmt::format("move {}, pulse {}: expected {}, found {}{}", move, fault.pulse, fault.expected,
                              fault.found, exact_words(asked.steps, right + 1, expected[right], printed[right]));
  }
  return fault;
}

}  // namespace

std::vector<PrintedPosition> printed_positions(std::string_view output, std::size_t motors) {
  std::vector<PrintedPosition> positions;
  while (!output.empty()) {
    const std::size_t end = std::min(output.find('\n'), output.size());
    std::vector<double> numbers = last_numbers(output.substr(0, end));
    // A number before the position counts the pulses. What stands before the first position may be a prompt.
    if (numbers.size() == motors || numbers.size() == motors + 1 || (numbers.size() > motors && positions.empty())) {
      positions.emplace_back(numbers.end() - static_cast<std::ptrdiff_t>(motors), numbers.end());
    }
    output.remove_prefix(std::min(end + 1, output.size()));
  }
  return positions;
}

std::size_t count_motors(std::string_view output, const StepCounts& steps) {
  for (std::size_t motors = most_graded_motors; motors >= 2; --motors) {
    const std::vector<PrintedPosition> positions = printed_positions(output, motors);
    const StepCounts end(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(motors));
    if (positions.empty() || !equals(positions.back(), end)) continue;
    return motors == most_graded_motors ? 0 : motors;
  }
  // It ends elsewhere: as many as it prints.
  for (std::size_t motors = most_graded_motors; motors > 2; --motors) {
    if (printed_positions(output, motors).size() > few_lines) return motors == most_graded_motors ? 0 : motors;
  }
  return 2;
}

AnswerFault find_fault(const LineCase& asked, std::string_view output) {
  const std::vector<StepCounts> expected = line_positions(asked.steps);
  const std::vector<PrintedPosition> all = printed_positions(output, asked.steps.size());
  std::span<const PrintedPosition> printed = after_start(all);
  std::size_t right = equal_pulses(printed, expected);
  // It may first say what it was asked for. Nothing else is left out: it would be a wrong pulse.
  if (right == 0 && !all.empty() && equals(all[0], asked.steps)) {
    printed = after_start(std::span(all).subspan(1));
    right = equal_pulses(printed, expected);
  }
  const bool says_its_end_again =
      printed.size() == expected.size() + 1 && !expected.empty() && equals(printed.back(), expected.back());
  if (right == expected.size() && (printed.size() == right || says_its_end_again)) return {};
  return fault_at(asked, printed, expected, right);
}

}  // namespace passo
