#include "passo/grading/board_case.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "board_vectors.hpp"
#include <fmt/format.h>

#include "passo/base/ensure.hpp"

namespace passo {
namespace {

constexpr int slower = 5;  // 4 MHz instead of 20 MHz

// A program may switch windings one after the other. What does not last so long is no current yet.
constexpr Nanoseconds settling = 10'000;

const std::vector<std::string> windings = {"windings.x", "windings.y", "windings.z"};

std::optional<Nanoseconds> time_of(const std::string& word) {
  double microseconds = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), microseconds);
  if (error != std::errc() || end != word.data() + word.size() || !(microseconds >= 0)) return {};
  return std::llround(microseconds * 1000);
}

bool read_words(const std::vector<std::string>& words, BoardCase& into) {
  if (words.size() == 2 && words[0] == "drive") {
    into.drive = words[1];
    return true;
  }
  const auto at = words.size() < 2 ? std::nullopt : time_of(words[0]);
  if (!at) return false;
  if (words.size() == 2 && words[1] == "end") {
    into.end = *at;
    return true;
  }
  if (words.size() == 4 && words[1] == "in" && (words[3] == "0" || words[3] == "1")) {
    into.lines.push_back({*at, words[2], words[3] == "1"});
    return true;
  }
  if (words.size() != 6 || words[1] != "out" || words[4] != "within") return false;
  const auto within = time_of(words[5]);
  if (!within) return false;
  into.due.push_back({{*at, words[2], words[3]}, *within});
  return true;
}

// Whether it is about the lines from the computer alone, all of which are low at first.
bool is_of_lines_alone(const BoardCase& one) {
  return std::ranges::none_of(one.lines, [](const LineChange& change) {
    return change.line.starts_with("key.") || change.line == "button" || change.line == "reset" || change.at == 0;
  });
}

BoardCase after_automatic_mode(const BoardCase& one) {
  constexpr Nanoseconds begin = 100'000'000;
  BoardCase later = one;
  for (LineChange& change : later.lines) change.at = begin + change.at * slower;
  for (DueChange& due : later.due) {
    due.change.at = begin + due.change.at * slower;
    due.within *= slower;
  }
  later.end = begin + one.end * slower;
  later.lines.insert(later.lines.begin(), {{10'000'000, "key.*", true}, {60'000'000, "key.*", false}});
  return later;
}

std::vector<std::string> windings_and(std::initializer_list<const char*> more) {
  std::vector<std::string> outputs = windings;
  outputs.insert(outputs.end(), more.begin(), more.end());
  return outputs;
}

bool is_first_board(const std::string& board) {
  return board.starts_with("first_board");
}

// One in a folder is for the board of this name alone.
bool is_of_board(std::string_view vector, const std::string& board) {
  return vector.starts_with(board + "/");
}
bool is_of_all_boards(std::string_view vector) {
  return vector.find('/') == std::string_view::npos;
}

bool asks_for_one_of(const std::vector<std::string>& outputs, const BoardCase& one) {
  return std::ranges::any_of(
      one.due, [&](const DueChange& due) { return std::ranges::find(outputs, due.change.output) != outputs.end(); });
}

// Without what lasts shorter than `shortest`.
std::vector<OutputChange> settled(const std::vector<OutputChange>& seen, Nanoseconds shortest) {
  std::vector<OutputChange> kept;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (i + 1 < seen.size() && seen[i + 1].at < seen[i].at + shortest) continue;
    if (seen[i].value != (kept.empty() ? "0000" : kept.back().value)) kept.push_back(seen[i]);
  }
  return kept;
}

std::string value_words(const std::string& value, Nanoseconds at) {
  return fmt::format("{} at {:.6g} ms", value, static_cast<double>(at) * 1e-6);
}

// The first fault of one output.
OutputFault fault_of(const std::string& output, const std::vector<DueChange>& due,
                     const std::vector<OutputChange>& seen) {
  for (std::size_t i = 0; i < std::max(due.size(), seen.size()); ++i) {
    const DueChange* const wanted = i < due.size() ? &due[i] : nullptr;
    const OutputChange* const came = i < seen.size() ? &seen[i] : nullptr;
    if (wanted != nullptr && came != nullptr && came->value == wanted->change.value && came->at >= wanted->change.at &&
        came->at <= wanted->change.at + wanted->within) {
      continue;
    }
    OutputFault fault{.output = output, .number = i + 1, .at = 0, .expected = {}, .found = {}, .words = {}};
    fault.at = wanted == nullptr ? came->at
               : came == nullptr ? wanted->change.at
                                 : std::min(came->at, wanted->change.at);
    if (wanted != nullptr) fault.expected = wanted->change.value;
    if (came != nullptr) fault.found = came->value;
    fault.words = fmt::format("{}, change {}: expected {}, found {}", output, i + 1,
                              wanted == nullptr ? "no change"
                                                : fmt::format("{}, at most {:g} ms later",
                                                              value_words(wanted->change.value, wanted->change.at),
                                                              static_cast<double>(wanted->within) * 1e-6),
                              came == nullptr ? "no change" : value_words(came->value, came->at));
    return fault;
  }
  return {};
}

}  // namespace

Result<BoardCase, std::string> read_board_case(const std::string& name, std::string_view text) {
  BoardCase read{.name = name};
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    if (words.empty() || words[0].starts_with('#')) continue;
    if (!read_words(words, read)) {
      return Failure{
          fmt::format("{}, line {}: expected TIME in LINE LEVEL, TIME out OUTPUT VALUE within SPAN, TIME end "
                      "or drive NAME, found '{}'",
                      name, number, line)};
    }
  }
  if (read.end == 0) return Failure{name + ": has no end"};
  std::ranges::stable_sort(read.lines, {}, &LineChange::at);
  return read;
}

const std::vector<std::string>& graded_boards() {
  static const std::vector<std::string> boards = [] {
    std::vector<std::string> all = {"first_board", "first_board_copied", "first_board_as_listed",
                                    "pic_two_on",  "pic_wave",           "pic_half_step"};
    std::erase_if(all, [](const std::string& board) {
      return is_first_board(board) && std::ranges::none_of(board_vector_texts(), [&](const BoardVectorText& vector) {
               return is_of_board(vector.name, board);
             });
    });
    return all;
  }();
  return boards;
}

std::vector<BoardCase> board_cases(const std::string& board) {
  const bool first = is_first_board(board);
  const std::string drive = first ? "two_on" : board.substr(board.find('_') + 1);
  std::vector<BoardCase> own;
  std::vector<BoardCase> shared;
  for (const BoardVectorText& vector : board_vector_texts()) {
    auto read = read_board_case(vector.name, vector.text);
    ensure(read.has_value(), "a built-in vector can be read");
    if (read->drive != drive) continue;
    if (is_of_board(vector.name, board)) {
      read->settling = slower * settling;
      read->outputs = windings_and({"relay", "indicator.relay", "led.0", "led.1", "led.2", "led.3"});
      own.push_back(*std::move(read));
    } else if (is_of_all_boards(vector.name) && !first) {
      read->settling = settling;
      read->outputs = windings_and({"relay", "indicator.relay", "indicator.automatic", "indicator.manual"});
      shared.push_back(*std::move(read));
    } else if (is_of_all_boards(vector.name) && is_of_lines_alone(*read)) {
      BoardCase later = after_automatic_mode(*read);
      later.settling = slower * settling;
      // The other images of the first board differ in the sense of the relay.
      later.outputs = board == "first_board" ? windings_and({"relay"}) : windings;
      if (asks_for_one_of(later.outputs, later)) shared.push_back(std::move(later));
    }
  }
  // What is easiest first: lines and windings.
  shared.insert(shared.end(), own.begin(), own.end());
  return shared;
}

OutputFault find_output_fault(const BoardCase& asked, std::span<const OutputChange> seen) {
  std::map<std::string, std::vector<DueChange>> due;
  std::map<std::string, std::vector<OutputChange>> came;
  for (const DueChange& change : asked.due) due[change.change.output].push_back(change);
  for (const OutputChange& change : seen) came[change.output].push_back(change);
  OutputFault first;
  for (const std::string& output : asked.outputs) {
    if (output.starts_with("windings.")) came[output] = settled(came[output], asked.settling);
    OutputFault fault = fault_of(output, due[output], came[output]);
    if (!fault.output.empty() && (first.output.empty() || fault.at < first.at)) first = std::move(fault);
  }
  return first;
}

}  // namespace passo
