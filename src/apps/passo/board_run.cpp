#include "board_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "board_opening.hpp"
#include "board_words.hpp"
#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/link/board_session.hpp"

namespace passo {
namespace {

// An Arduino whose line is opened is in its boot loader for up to two seconds.
constexpr Seconds first_answer{4};
constexpr Seconds answer{2};

}  // namespace

BoardRun::BoardRun(std::unique_ptr<BoardPort> port, std::uint8_t motors, Plant* plant)
    : port_(std::move(port)), motors_(motors), plant_(plant) {}

std::unique_ptr<BoardRun> BoardRun::open(const std::string& address, std::uint8_t motors, bool may_move, Plant& plant,
                                         int& code) {
  const auto parsed = parse_board_address(address);
  if (!parsed) {
    code = fail(exit_bad_program, parsed.error());
    return nullptr;
  }
  auto port = open_addressed(*parsed, &plant);
  if (!port) {
    code = fail(exit_failed, port.error());
    return nullptr;
  }
  const bool is_emulated = parsed->kind == BoardAddress::Kind::emulated;
  std::unique_ptr<BoardRun> run(new BoardRun(std::move(*port), motors, is_emulated ? &plant : nullptr));
  Inquiry inquiry(run->port());
  if (const auto status = inquiry.status(first_answer)) {
    run->before_ = *status;
    if ((status->state & board_manual) != 0) {
      code = fail(exit_failed, fmt::format("{}: {}", address, message_of(LinkError::manual)));
      return nullptr;
    }
    if (may_move || (status->state & board_moves) == 0) return run;
    code = fail(exit_failed, address + ": it moves: another program runs on it, or has just left it");
    return nullptr;
  }
  // The greeting has kept its form in all versions: what does not answer a question may answer that.
  const BoardLink greeting(run->port(), motors, {.answer_within = Seconds(0.25), .patience = Seconds(1)});
  const LinkError error = greeting.error().value_or(LinkError::wrong_version);
  code = fail(exit_failed, fmt::format("{}: {}", address, message_of(error)));
  return nullptr;
}

bool BoardRun::wait_for_rest() {
  const auto status = Inquiry(*port_).status_at_rest(answer);
  if (status) before_ = *status;
  return status.has_value();
}

bool BoardRun::stands_at(const std::array<std::int64_t, max_motors>& steps) {
  if (!wait_for_rest()) return false;
  for (unsigned motor = 0; motor < motors_; ++motor) {
    before_.positions[motor] -= static_cast<std::int32_t>(steps[motor]);
  }
  return true;
}

void BoardRun::count_from(const std::vector<int>& counts) {
  std::copy(counts.begin(), counts.end(), before_.positions);
}

std::optional<std::string> BoardRun::compare(const MachineCounts& planned) {
  const auto after = Inquiry(*port_).status(answer);
  if (!after) return "it does not answer any more; whether all was done is not known";
  for (unsigned motor = 0; motor < motors_; ++motor) {
    const std::int64_t counted = std::int64_t{after->positions[motor]} - before_.positions[motor];
    if (counted == planned.motors[motor].position) continue;
    return fmt::format("motor {} stands {} steps from its start, and {} were planned", motor + 1, counted,
                       planned.motors[motor].position);
  }
  if (plant_ == nullptr) return {};
  const Truth truth = plant_->truth_at(port_->elapsed());
  for (unsigned motor = 0; motor < motors_; ++motor) {
    const auto steps = std::llround(truth.positions[motor]);
    if (steps == planned.motors[motor].position) continue;
    return fmt::format("motor {} is truly {} steps from machine zero, and {} were planned", motor + 1, steps,
                       planned.motors[motor].position);
  }
  return {};
}

void BoardRun::tell(const Refiller& refiller) const {
  if (refiller.recoveries() == 0) return;
  fmt::print(stderr,
             "passo: nothing had come to the board in time, {}: it came to rest on the path, and went on from there\n",
             refiller.recoveries() == 1 ? "once" : fmt::format("{} times", refiller.recoveries()));
}

}  // namespace passo
