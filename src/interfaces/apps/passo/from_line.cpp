#include "from_line.hpp"

#include <cstdio>
#include <iostream>
#include <string>

#include "operator_prompt.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

bool is_agreed() {
  fmt::print(stderr, "passo: is this correct, and is the path clear? [y/N] ");
  std::string answer;
  return std::getline(std::cin, answer) && (answer == "y" || answer == "Y" || answer == "yes");
}

}  // namespace

std::optional<Reentry> way_to_line(const RunArguments& arguments, const ProgramReader& program,
                                   const MachineDescription& machine, const InterpreterOptions& options, int& code) {
  auto way =
      reentry_at_line(program, machine, options,
                      {.line = arguments.start.line, .pass = arguments.start.pass, .after = Mm(arguments.start.after)});
  if (!way) {
    const LineProblem& problem = way.error();
    const bool is_pass = problem.refusal == ReentryRefusal::done_often || problem.refusal == ReentryRefusal::no_pass;
    code = fail(exit_bad_program,
                fmt::format("--from-line {}: {}{} [{}]", arguments.start.line, message_of(problem),
                            is_pass ? fmt::format(", as --pass {}", problem.times) : "", code_of(problem.refusal)));
    return {};
  }
  fmt::print(stderr, "passo: the next moves (machine coordinates):\n");
  for (std::size_t i = 0; i < way->steps.size(); ++i) fmt::print(stderr, "  {}. {}\n", i + 1, way->steps[i].text);
  if (!arguments.yes && asks_operator() && !is_agreed()) {
    code = fail(exit_failed, "the machine has not moved");
    return {};
  }
  if (!arguments.yes && !asks_operator() && arguments.board != "virtual") {
    code = fail(exit_bad_program,
                "--from-line asks before a real machine moves, but there is no terminal: add --yes if the moves above "
                "are correct [run.from-line-unasked]");
    return {};
  }
  return std::move(*way);
}

}  // namespace passo
