// JudgedProgram: a program checked on a machine with tools 1 to 3. For tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/judge/judgement.hpp"
#include "passo/judge/proposals.hpp"

namespace passo::test {

struct JudgedProgram {
  JudgedProgram(MachineDescription on, const std::string& text)
      : machine(std::move(on)), program(ProgramReader::from_text("part.ngc", text)) {
    options.tools.name = "tool.tbl";
    for (const std::int32_t tool : {1, 2, 3}) EXPECT_TRUE(options.tools.add({.number = tool, .pocket = tool}));
    check_again();
  }
  void check_again() {
    findings.clear();
    check = check_program(program.again(), machine, options, findings);
  }

  Judgement judge(const JudgeWatchers& watchers = {}, const MotionFactors& factors = {}) const {
    EXPECT_TRUE(check.good) << render(findings, false);
    return passo::judge(program.again(), machine, options, check, watchers, {}, factors);
  }
  Seconds planned_time() const { return passo::planned_time(program.again(), machine, options, check); }
  std::vector<Proposal> proposals() const {
    const auto judged = check.good ? std::optional(judge()) : std::nullopt;
    return proposals_of({program, machine, options}, check, findings, judged ? &*judged : nullptr);
  }

  MachineDescription machine;
  ProgramReader program;
  InterpreterOptions options;
  Diagnostics findings;
  ProgramCheck check;
};

}  // namespace passo::test
