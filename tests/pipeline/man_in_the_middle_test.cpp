// A man in the middle makes a thousand faults of each kind on a board's line: every step is made all the same, and no
// run hangs.
#include "kit/man_in_the_middle.hpp"

#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::ManInTheMiddle;
using test::Mischief;
using test::StepLog;

constexpr const char* program =
    "G21 G90 G64 P.02 F3000 M3 S1000\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM8\nG4 P.05\nG0 X0 Y0 Z2\nM5 M9\nM2\n";
// The program takes 3 s; each fault may cost a rest.
constexpr Seconds longest{600};

StepLog::Steps steps_of(const MachineDescription& machine, ManInTheMiddle* man) {
  Diagnostics diagnostics;
  test::DriveOn on;
  if (man != nullptr) on.line.emplace();
  test::DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics, on);
  StepLog log;
  job.machine().add_observer(log);
  if (man != nullptr) {
    job.line().set_trouble([man](bool to_board, const test::Bytes& bytes) { return (*man)(to_board, bytes); });
  }
  while (job.advance()) {
    if (job.machine().elapsed() < longest) continue;
    ADD_FAILURE() << "it hangs";
    break;
  }
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  return log.steps;
}

void make_faults(const std::string& name, int wanted) {
  const MachineDescription machine = test::example_machine(name);
  const StepLog::Steps reference = steps_of(machine, nullptr);
  const std::uint64_t seed = test::seed();
  for (const Mischief mischief : test::every_mischief) {
    int faults = 0;
    std::uint64_t runs = 0;
    for (; faults < wanted && !testing::Test::HasFailure(); ++runs) {
      SCOPED_TRACE(std::string(test::name_of(mischief)) + ", run " + std::to_string(runs));
      ManInTheMiddle man(mischief, seed + runs);
      const StepLog::Steps steps = steps_of(machine, &man);
      test::expect_same_way(steps, reference);
      test::expect_within_limits(machine, steps);
      ASSERT_GT(man.faults, 0);
      faults += man.faults;
    }
    std::printf("%s: %d faults in %d runs\n", std::string(test::name_of(mischief)).c_str(), faults,
                static_cast<int>(runs));
  }
}

class ManOnTheLine : public testing::TestWithParam<std::string> {};
class ManOnTheLineInFull : public test::InFull<testing::TestWithParam<std::string>> {};

TEST_P(ManOnTheLine, changes_no_step) {
  make_faults(GetParam(), test::fewer(1000, 5));
}
TEST_P(ManOnTheLineInFull, changes_no_step_by_a_thousand_faults_of_each_kind) {
  make_faults(GetParam(), static_cast<int>(1000 / test::in_full()));
}

INSTANTIATE_TEST_SUITE_P(Board, ManOnTheLine, testing::Values("router", "uno"));
INSTANTIATE_TEST_SUITE_P(Board, ManOnTheLineInFull, testing::Values("router", "uno"));

}  // namespace
}  // namespace passo
