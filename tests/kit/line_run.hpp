// Runs a program with the board at the other end of a link. A test may disturb the data on the link.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/line_trouble.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

namespace passo::test {

struct Outcome {
  StepLog::Steps steps;
  std::vector<int> outputs;
  std::uint64_t frames = 0;  // number of frames in both directions
  int recoveries = 0;
};

// Receives each frame with its number. Returns the bytes that are delivered.
using Trouble = std::function<Bytes(DrivenProgram& job, std::uint64_t number, bool to_board, Bytes bytes)>;

inline Outcome run(const MachineDescription& machine, const std::string& program, bool with_line,
                   const Trouble& trouble = nullptr) {
  Diagnostics diagnostics;
  const auto line = with_line ? std::optional(LineOptions{}) : std::nullopt;
  // Disturbances begin with the first frame after the handshake, because a job that does not find its board never
  // begins.
  DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics, {.line = line});
  StepLog log;
  job.machine().add_observer(log);
  Outcome outcome;
  if (with_line) {
    job.line().set_trouble([&](bool to_board, Bytes bytes) {
      const std::uint64_t number = outcome.frames++;
      return trouble ? trouble(job, number, to_board, std::move(bytes)) : bytes;
    });
  }
  while (job.advance()) {
  }
  EXPECT_FALSE(diagnostics.any_error());
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  outcome.steps = log.steps;
  if (job.drive().ledger() != nullptr) outcome.recoveries = job.drive().ledger()->recoveries();
  return outcome;
}

}  // namespace passo::test
