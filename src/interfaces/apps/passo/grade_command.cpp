// passo grade lines, passo grade board: a student's program, or those of a class, against the definition.
#include "grade_command.hpp"

#include <filesystem>
#include <sstream>

#include "grade_page.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "run_outputs.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>

#include "passo/confinement/confinement.hpp"
#include "passo/grading/board_grading.hpp"
#include "passo/grading/line_grading.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using Submissions = Result<std::vector<Submission>, std::string>;

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool is_file(const std::string& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

// "python3 anna.py": the file in it is what was handed in.
Submissions submission_of_command(const std::string& text) {
  Submission submission{.student = text, .handed = {}, .command = words_in(text)};
  for (std::string& word : submission.command) {
    if (!is_file(word)) continue;
    if (!submission.handed.empty()) {
      return Failure{fmt::format("{}: {} and {} are both files; a program of several files is a folder of a class",
                                 text, submission.handed.string(), word)};
    }
    submission.handed = word;
    word = "{}";
  }
  const bool has_program = !submission.handed.empty() || submission.command[0].find('/') == std::string::npos;
  if (has_program && submission.command.size() > 1) return std::vector<Submission>{submission};
  return Failure{text + ": expected a program, a command line in quotes, or the folder of a class"};
}

// `ending`: of the files of a class; empty: any.
Submissions submissions_of(const std::string& program, const std::string& run, const std::string& ending = "") {
  const std::vector<std::string> command = words_in(run);
  std::error_code none;
  if (fs::is_directory(program, none)) {
    std::vector<Submission> all = submissions_in(program, ending, command);
    if (all.empty()) {
      return Failure{fmt::format("{}: expected a {}file or a folder for each student, found none", program,
                                 ending.empty() ? "" : ending + " ")};
    }
    return all;
  }
  if (is_file(program)) {
    const fs::path file = fs::canonical(program, none);
    return std::vector<Submission>{{fs::path(program).stem().string(), file, command}};
  }
  if (words_in(program).empty()) return Failure{std::string("PROGRAM: expected a name")};
  return submission_of_command(program);
}

int write_file(const std::string& path, const std::string& text) {
  auto file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(text);
  const Status<OutputError> done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

std::string refuse_outputs(const GradeOutputs& outputs) {
  if (!outputs.csv.empty() && !outputs.csv.ends_with(".csv")) return outputs.csv + ": the name must end with .csv";
  if (!outputs.report.empty() && !outputs.report.ends_with(".html")) {
    return outputs.report + ": the name must end with .html";
  }
  return "";
}

// `grade_one` grades one student; it gets a function for the progress, 0 to 1.
template <class GradeOne>
int grade_all(const std::string& title, const std::string& program, const std::vector<Submission>& submissions,
              const GradeOutputs& outputs, const GradeOne& grade_one) {
  std::error_code none;
  catch_signals();
  GradePage page{.title = title, .grades = {}, .is_class = fs::is_directory(program, none)};
  {
    ProgressDisplay progress("grade");
    for (const Submission& submission : submissions) {
      const auto watch = [&](double share) {
        progress.update((static_cast<double>(page.grades.size()) + share) / static_cast<double>(submissions.size()));
        return interrupted_by() == 0;
      };
      Result<Grade, std::string> grade = grade_one(submission, watch);
      if (!grade) {
        progress.clear();
        return fail(exit_failed, grade.error());
      }
      if (interrupted_by() != 0) return exit_of_signal();
      make_printable(*grade);
      page.grades.push_back(*std::move(grade));
    }
  }
  if (!outputs.csv.empty()) {
    if (const int code = write_file(outputs.csv, to_csv(page)); code != exit_done) return code;
  }
  if (!outputs.report.empty()) {
    if (const int code = write_file(outputs.report, to_html(page)); code != exit_done) return code;
  }
  fmt::print("{}", outputs.json ? to_json(page) : to_text(page));
  return exit_done;
}

}  // namespace

int grade_lines_command(const GradeLinesArguments& arguments) {
  if (const std::string why = refuse_outputs(arguments.outputs); !why.empty()) return fail(exit_bad_program, why);
  if (!arguments.run.empty() && arguments.run.find("{}") == std::string::npos) {
    return fail(exit_bad_program, "--run: expected {} where the student's file stands, e.g. --run 'python3 {}'");
  }
  const Submissions submissions = submissions_of(arguments.program, arguments.run);
  if (!submissions) return fail(exit_bad_program, submissions.error());
  const Status<std::string> can = check_confinement();
  if (!can && !arguments.unconfined) {
    return fail(exit_failed, can.error() +
                                 ", so a program could read your files and use the network; --unconfined runs programs "
                                 "that you trust");
  }
  LineGrading grading{.signs = arguments.signs,
                      .asks_count = arguments.count_first,
                      .unconfined = arguments.unconfined,
                      .readable = arguments.readable};
  grading.limits.memory = std::uint64_t{arguments.memory} << 20;
  if (arguments.motors == "any") {
    grading.motors = 0;
  } else if (!arguments.motors.empty()) {
    grading.motors = static_cast<std::size_t>(arguments.motors[0] - '0');
  }
  bool lacks_run = false;
  const int code = grade_all("Lines, pulse by pulse", arguments.program, *submissions, arguments.outputs,
                             [&](const Submission& submission, const auto& watch) {
                               Result<Grade, std::string> grade = grade_lines(submission, grading, watch);
                               if (grade && grade->trouble.starts_with("no program")) lacks_run = arguments.run.empty();
                               return grade;
                             });
  if (lacks_run) note("files that are not executable are run with --run, e.g. --run 'python3 {}'");
  return code;
}

int grade_board_command(const GradeBoardArguments& arguments) {
  if (const std::string why = refuse_outputs(arguments.outputs); !why.empty()) return fail(exit_bad_program, why);
  std::error_code none;
  if (!fs::exists(arguments.program, none)) {
    return fail(exit_bad_program, arguments.program + ": there is no such file or folder");
  }
  const Submissions submissions = submissions_of(arguments.program, "", ".hex");
  if (!submissions) return fail(exit_bad_program, submissions.error());
  return grade_all(
      "Programs for the PIC16F877A on " + arguments.board, arguments.program, *submissions, arguments.outputs,
      [&](const Submission& submission, const auto& watch) { return grade_board(submission, arguments.board, watch); });
}

}  // namespace passo
