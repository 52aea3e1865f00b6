#include "interpolate_dialogue.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program_input.hpp"
#include "study_moves.hpp"
#include "terminal.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/interpolate/bresenham_line.hpp"
#include "passo/report/output_file.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

struct DialogueWords {
  std::string_view language;
  const char* question;    // {0}: number of the motor
  const char* with_end;    // the same from the second motor on
  const char* not_number;  // {0}: the word that was entered
  const char* nothing;
};

constexpr DialogueWords all_words[] = {
    {"en", "Steps of motor {}: ", "Steps of motor {} (an empty line ends the list): ",
     "'{}' is not a number of steps; expected a whole number from -2147483647 to 2147483647",
     "expected the steps of at least one motor"},
    {"it", "Passi del motore {}: ", "Passi del motore {} (una riga vuota chiude l'elenco): ",
     "'{}' non è un numero di passi; serve un numero intero da -2147483647 a 2147483647",
     "servono i passi di almeno un motore"},
    {"fr", "Pas du moteur {} : ", "Pas du moteur {} (une ligne vide termine la liste) : ",
     "« {} » n'est pas un nombre de pas ; il faut un nombre entier de -2147483647 à 2147483647",
     "il faut les pas d'un moteur au moins"},
    {"zh", "电机 {} 的步数：", "电机 {} 的步数（空行结束）：", "“{}”不是步数；应为 -2147483647 到 2147483647 的整数",
     "至少要输入一个电机的步数"}};

// The first of the variables that is set decides, as for the C library.
const DialogueWords& words_of_user() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* const value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    for (const DialogueWords& words : all_words) {
      if (std::string_view(value).substr(0, 2) == words.language) return words;
    }
    break;
  }
  return all_words[0];
}

std::optional<std::int64_t> steps_of(std::string_view word) {
  std::int64_t steps = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), steps);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  constexpr std::int64_t most = 2'147'483'647;
  return steps < -most || steps > most ? std::nullopt : std::optional(steps);
}

// Several numbers in a line are several motors, as for `cin >>`. Returns the word that is no number; empty: none.
std::string add_motors(std::string_view line, Place& motors) {
  constexpr std::string_view gaps = " \t\r,;";
  Place found;
  for (std::size_t begin = line.find_first_not_of(gaps); begin < line.size();) {
    const std::size_t end = std::min(line.find_first_of(gaps, begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    const std::optional<std::int64_t> steps = steps_of(word);
    if (!steps) return std::string(word);
    found.push_back(*steps);
    begin = line.find_first_not_of(gaps, end);
  }
  motors.insert(motors.end(), found.begin(), found.end());
  return {};
}

// Asks until the list ends. The error is a word that is no number; at a terminal the question is asked again instead.
Result<Place, std::string> ask_for_motors(const DialogueWords& words) {
  const bool answers_a_person = is_terminal(STDIN_FILENO);
  Place motors;
  std::string line;
  while (true) {
    fmt::print(stderr, fmt::runtime(motors.empty() ? words.question : words.with_end), motors.size() + 1);
    if (!answers_a_person) fmt::print(stderr, "\n");
    std::fflush(stderr);
    if (!std::getline(std::cin, line)) {
      if (answers_a_person) fmt::print(stderr, "\n");
      return motors;
    }
    const std::size_t before = motors.size();
    const std::string wrong = add_motors(line, motors);
    if (!wrong.empty()) {
      const std::string sentence = fmt::format(fmt::runtime(words.not_number), wrong);
      if (!answers_a_person) return Failure{sentence};
      fmt::print(stderr, "{}\n", sentence);
    } else if (motors.size() == before) {
      return motors;
    }
  }
}

void add_row(const Place& place, std::string& text) {
  for (const std::int64_t steps : place) fmt::format_to(std::back_inserter(text), "{}\t", steps);
  text += '\n';
}

// Every slave depends on the master only. So any number of motors are lines of at most eight axes, each with the master
// as its first axis.
void write_lean(const Place& motors, OutputFile& file) {
  constexpr std::size_t slaves = most_axes - 1;
  std::int64_t master = 0;
  for (const std::int64_t steps : motors) master = std::max(master, std::abs(steps));
  std::vector<BresenhamLine<most_axes>> lines;
  for (std::size_t first = 0; first < motors.size(); first += slaves) {
    std::int32_t distances[most_axes] = {static_cast<std::int32_t>(master)};
    for (std::size_t i = 0; i < slaves && first + i < motors.size(); ++i) {
      distances[1 + i] = static_cast<std::int32_t>(motors[first + i]);
    }
    lines.emplace_back(distances);
  }
  Place place(motors.size(), 0);
  std::string text;
  while (!lines.front().done() && !file.failed()) {
    for (std::size_t line = 0; line < lines.size(); ++line) {
      const Pulse pulse = lines[line].next();
      for (std::size_t i = 0; i < slaves && line * slaves + i < motors.size(); ++i) {
        if ((pulse.steps >> (1 + i) & 1) == 0) continue;
        place[line * slaves + i] += (pulse.directions >> (1 + i) & 1) != 0 ? -1 : 1;
      }
    }
    text.clear();
    add_row(place, text);
    file.write(text);
  }
}

Status<std::string> write_sequence(const Method& method, const Place& motors, OutputFile& file) {
  if (method.name == MethodName::lean) {
    write_lean(motors, file);
    return Unit{};
  }
  const StepMove move{.from = Place(motors.size(), 0), .to = motors, .arc = {}};
  if (const Status<std::string> good = check(move); !good) return Failure{"the move " + good.error()};
  auto source = start(method, move);
  if (!source) return Failure{title(method) + " " + source.error()};
  Place place = move.from;
  std::string text;
  while (!(*source)->done() && !file.failed()) {
    apply((*source)->next(), place);
    text.clear();
    add_row(place, text);
    file.write(text);
  }
  return Unit{};
}

}  // namespace

int interpolate_dialogue(const InterpolateArguments& arguments) {
  const Result<Method, std::string> method = method_of(arguments);
  if (!method) return fail(exit_bad_program, method.error());
  const DialogueWords& words = words_of_user();
  const Result<Place, std::string> motors = ask_for_motors(words);
  if (!motors) return fail(exit_bad_program, motors.error());
  if (motors->empty()) return fail(exit_bad_program, words.nothing);
  auto file = OutputFile::open("-");
  if (!file) return fail(exit_failed, file.error().message);
  const Status<std::string> done = write_sequence(*method, *motors, *file);
  if (!done) return fail(exit_bad_program, done.error());
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

}  // namespace passo
