#include "passo/grading/line_grading.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/base/counted.hpp"
#include "passo/confinement/temporary_folder.hpp"
#include "passo/grading/line_answer.hpp"

namespace passo {
namespace {

using End = ConfinedRun::End;

// Each takes seconds: two are enough to know.
constexpr int most_stopped_runs = 2;

class LineGrader {
 public:
  LineGrader(const Submission& submission, const LineGrading& grading, const GradingWatch& watch)
      : submission_(submission), grading_(grading), watch_(watch) {}

  bool is_stopped() const { return watch_ && !watch_(share()); }

  // A run with a fresh copy. Empty: the grade has the trouble, or there is an error.
  std::optional<ConfinedRun> play(const StepCounts& steps) {
    TemporaryFolder folder;
    if (!folder.make()) {
      error = "cannot create a temporary folder";
      return {};
    }
    const Status<std::string> copied = copy_submission(submission_, folder.name());
    const auto command = copied ? command_for(submission_, folder.name(), "lines")
                                : Result<std::vector<std::string>, std::string>(Failure{copied.error()});
    if (!command) {
      grade.trouble = command.error();
      return {};
    }
    grade.program = fmt::format("{}", fmt::join(*command, " "));
    auto run = run_confined({.folder = folder.name(),
                             .words = *command,
                             .input = dialogue_for(steps, grading_.asks_count),
                             .readable = grading_.readable,
                             .unconfined = grading_.unconfined,
                             .limits = grading_.limits,
                             .is_cancelled = [this] { return is_stopped(); }});
    if (!run) {
      error = run.error();
      return {};
    }
    if (run->end == End::not_started) {
      grade.trouble = grade.program + " " + describe_end(*run, grading_.limits);
      return {};
    }
    return *std::move(run);
  }

  CaseGrade judge(const LineCase& asked, const ConfinedRun& run) const {
    const AnswerFault fault = find_fault(asked, run.output);
    CaseGrade result{.name = describe_steps(asked.steps), .why = asked.why};
    const std::string end = describe_end(run, grading_.limits);
    // Many a program of beginners ends with a code other than 0.
    const bool ended = run.end == End::exited;
    result.is_right = fault.words.empty() && ended;
    if (result.is_right) return result;
    result.pulse = fault.pulse;
    result.expected = fault.expected;
    result.found = fault.found;
    result.fault = fault.words.empty() ? fmt::format("move {}: its positions are right, but it {}", result.name, end)
                   : ended && (!fault.found.empty() || end.empty()) ? fault.words
                                                                    : fmt::format("{}; it {}", fault.words, end);
    if (fault.found.empty() && !run.messages.empty()) result.fault += last_message(run.messages);
    return result;
  }

  Grade grade;
  std::string error;

 private:
  double share() const {
    return grade.cases == 0 ? 0 : static_cast<double>(grade.played.size()) / static_cast<double>(grade.cases);
  }

  // The last line of what it wrote to standard error, e.g. a Python exception.
  static std::string last_message(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
    text.erase(0, text.rfind('\n') + 1);
    for (char& letter : text) {
      if (static_cast<unsigned char>(letter) < ' ' || letter == '\x7f') letter = ' ';
    }
    constexpr std::size_t longest = 200;
    return text.empty() ? "" : "; it says: " + text.substr(0, longest);
  }

  const Submission& submission_;
  const LineGrading& grading_;
  const GradingWatch& watch_;
};

bool was_stopped(const ConfinedRun& run) {
  return run.end != End::exited && run.end != End::crashed;
}

// What a trial with eight motors shows.
struct Trial {
  std::size_t motors = 2;
  bool prints_positions = false;
  bool was_stopped = false;
};
Trial trial_of(LineGrader& grader) {
  const StepCounts eight = {16, 1, 2, 4, 8, 15, 3, 0};
  const std::optional<ConfinedRun> run = grader.play(eight);
  if (!run) return {};
  return {.motors = count_motors(run->output, eight),
          .prints_positions = !printed_positions(run->output, 2).empty(),
          .was_stopped = was_stopped(*run)};
}

// A program that prints nothing has done nothing for a move without a pulse.
void discount_nothing(Grade& grade) {
  const auto is_of_pulses = [](const CaseGrade& one) {
    return one.name.find_first_of("123456789") != std::string::npos;
  };
  if (std::ranges::any_of(grade.played, [&](const CaseGrade& one) { return one.is_right && is_of_pulses(one); }))
    return;
  for (CaseGrade& one : grade.played) {
    if (!one.is_right) continue;
    one.is_right = false;
    one.fault = fmt::format("move {}: not counted, since no other move is right", one.name);
  }
}

std::string remark_of(std::size_t motors) {
  if (motors == 0) return "it asks for any number of motors";
  return fmt::format("it asks for {} motors; moves of more were not played", motors);
}

}  // namespace

std::string dialogue_for(const std::vector<std::int64_t>& steps, bool asks_count) {
  return fmt::format("{}{}\n\n", asks_count ? fmt::format("{}\n", steps.size()) : "", fmt::join(steps, "\n"));
}

Result<Grade, std::string> grade_lines(const Submission& submission, const LineGrading& grading,
                                       const GradingWatch& watch) {
  LineGrader grader(submission, grading, watch);
  grader.grade.student = submission.student;
  std::size_t motors = grading.motors;
  int stopped = 0;
  if (motors == LineGrading::as_the_program) {
    // A program that reads the number of motors asks for any.
    const Trial trial = grading.asks_count ? Trial{.motors = 0} : trial_of(grader);
    motors = trial.motors;
    if (trial.prints_positions) grader.grade.remark = remark_of(motors);
    if (trial.was_stopped) ++stopped;
  }
  const std::vector<LineCase> cases = line_cases(motors, grading.signs);
  std::vector<CaseGrade>& played = grader.grade.played;
  grader.grade.cases = cases.size();
  for (const LineCase& one : cases) {
    if (!grader.error.empty()) return Failure{grader.error};
    if (!grader.grade.trouble.empty()) break;
    if (grader.is_stopped()) break;
    const std::optional<ConfinedRun> run = grader.play(one.steps);
    if (!run) continue;
    played.push_back(grader.judge(one, *run));
    if (!was_stopped(*run) || ++stopped < most_stopped_runs || played.size() == cases.size()) continue;
    grader.grade.remark = fmt::format("it was stopped {} times; {} played", stopped,
                                      counted(cases.size() - played.size(), "case was not", "cases were not"));
    break;
  }
  if (!grader.error.empty()) return Failure{grader.error};
  discount_nothing(grader.grade);
  return std::move(grader.grade);
}

}  // namespace passo
