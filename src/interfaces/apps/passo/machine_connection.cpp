#include "machine_connection.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "board_opening.hpp"
#include "board_words.hpp"
#include "commands.hpp"
#include "link_monitor.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include "spindle_opening.hpp"
#include "state_folder.hpp"
#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/base/counted.hpp"
#include "passo/job/state_file.hpp"
#include "passo/judge/link_delay.hpp"
#include "passo/link/await.hpp"

namespace passo {
namespace {

// An Arduino whose line is opened is in its boot loader for up to two seconds.
constexpr Seconds first_answer{4};
constexpr Seconds answer{2};

constexpr LinkTimeouts real_line{.answer_within = Seconds(0.1), .patience = Seconds(60)};

unsigned any_number(unsigned least, unsigned most) {
  std::random_device random;
  return std::uniform_int_distribution<unsigned>(least, most)(random);
}

// Why the board cannot do what the machine file asks of it, as a sentence without a full stop. Empty: it can.
std::string unsuited_to(const BoardDescription& board, const About& about) {
  if (about.highest_event_rate != 0 && board.highest_event_rate.value() > about.highest_event_rate) {
    return fmt::format(
        "it makes at most {} events/s, fewer than max_event_rate_hz = {:.0f} of the machine file: lower "
        "max_event_rate_hz to {} or less [board.event-rate]",
        about.highest_event_rate, board.highest_event_rate.value(), about.highest_event_rate);
  }
  return "";
}

MotorSteps zero_counts_of(const MachineDescription& machine, const BoardStatus& status, const Point& place) {
  MotorSteps counts = steps_at(machine, place);
  for (std::size_t m = 0; m < counts.size(); ++m) counts[m] = status.positions[m] - counts[m];
  return counts;
}

}  // namespace

MachineConnection::MachineConnection(const MachineDescription& machine, const MachineWish& wish)
    : description_(machine),
      machine_(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate,
               static_cast<std::size_t>(machine.board.held_items)) {
  if (wish.physics) {
    auto rotors = std::make_unique<RotorPlant>();
    rotors_ = rotors.get();
    plant_ = std::move(rotors);
  } else {
    plant_ = std::make_unique<IdealPlant>();
  }
  fit(*plant_, machine, Point(), wish.touchables);
  if (machine.handwheel) machine_.fit_handwheel();
  if (rotors_ == nullptr) return;
  fit_rotors(*rotors_, machine);
  for (const Disturbance& disturbance : wish.disturbances) rotors_->disturb(disturbance);
}

std::unique_ptr<MachineConnection> MachineConnection::open(const MachineDescription& machine, const MachineWish& wish,
                                                           int& code) {
  std::unique_ptr<MachineConnection> opened(new MachineConnection(machine, wish));
  if (wish.board == "virtual") {
    if (!wish.plant_apart) opened->machine_.connect(*opened->plant_);
    opened->machine_.wire(pin_setup(machine));
    const KnownPosition at_zero{.place = Point(), .trust = Trust::commanded};
    if (!wish.over_a_line) {
      opened->session_ = std::make_unique<BoardMachineSession>(
          machine, opened->machine_,
          SessionOptions{.tells_place = wish.tells_place, .start = at_zero, .needs_place = wish.needs_place});
      // For its switches. Over a line, the greeting asks.
      static_cast<void>(ask_status(opened->session_->board(), answer).has_value());
      return opened;
    }
    opened->line_.emplace(opened->machine_, machine.board.clock, LineOptions());
    if (wish.cut) opened->line_->cut(wish.cut->at, wish.cut->missing);
    opened->session_ = std::make_unique<BoardMachineSession>(machine, *opened->line_,
                                                             SessionOptions{.over_a_line = true,
                                                                            .care = virtual_line_care,
                                                                            .greeting = {.session = 1},
                                                                            .tells_place = wish.tells_place,
                                                                            .start = at_zero,
                                                                            .needs_place = wish.needs_place});
    return opened;
  }
  const auto address = parse_board_address(wish.board);
  if (!address) {
    code = fail(exit_bad_program, address.error());
    return nullptr;
  }
  const bool outlives = address->kind != BoardAddress::Kind::emulated;
  if (outlives) {
    auto claim = BoardClaim::acquire(*address);
    if (!claim) {
      code = fail(exit_failed, claim.error());
      return nullptr;
    }
    opened->claim_.emplace(std::move(*claim));
    opened->stored_position_.emplace(state_file(state_folder(), wish.board, ".place"));
  }
  if (outlives && wish.spindle != SpindleWish::none && machine.spindle.modbus) {
    opened->spindle_ = open_spindle(*machine.spindle.modbus, wish.spindle, code);
    if (!opened->spindle_) return nullptr;
  }
  auto port = open_addressed(*address, opened->plant_.get(), pin_setup(machine));
  if (!port) {
    code = fail(exit_failed, port.error());
    return nullptr;
  }
  opened->port_ = std::move(*port);
  opened->plant_is_behind_ = !outlives;
  opened->session_ = std::make_unique<BoardMachineSession>(machine, *opened->port_,
                                                           SessionOptions{.over_a_line = true,
                                                                          .care = real_line,
                                                                          .greeting = {.session = 1},
                                                                          .tells_place = wish.tells_place,
                                                                          .start = {},
                                                                          .needs_place = wish.needs_place,
                                                                          .spindle = opened->spindle_.get()});
  if (!opened->ask_first(wish.board, wish.may_move, code)) return nullptr;
  opened->stand_as_counted();
  return opened;
}

MachineConnection::~MachineConnection() {
  keep_place();
}

Result<KnownPosition, PositionDoubt> MachineConnection::place() const {
  if (!stored_position_) return KnownPosition{.place = Point(), .trust = Trust::commanded};
  return stored_position_->place(description_, before_);
}

void MachineConnection::stand_as_counted() {
  start_at(stored_position_ ? stored_position_->counted(description_, before_)
                            : KnownPosition{.place = Point(), .trust = Trust::commanded});
}

// Greeting and session number differ from those of the board's last session, and mean nothing else: 1 is every
// stranger's.
Greeting MachineConnection::any_greeting() const {
  if (!stored_position_) return {.session = has_board() || line_ ? std::uint16_t{1} : std::uint16_t{0}};
  return {.session = new_session_number(), .number = static_cast<std::uint8_t>(any_number(1, 255))};
}

std::uint16_t MachineConnection::new_session_number() const {
  const auto& status = session_->board().status();
  const std::uint16_t present = status ? status->session : before_.session;
  std::uint16_t number = 0;
  do {
    number = static_cast<std::uint16_t>(any_number(2, 65535));
  } while (number == present);
  return number;
}

void MachineConnection::stand_in_truth_at(const Point& place) {
  plant_->stand_at(truth_at(description_, place));
  machine_.connect(*plant_);
}

void MachineConnection::write_down(const KnownPosition& position, const MotorSteps& zero_counts,
                                   const SessionNumbers& numbers) {
  if (!stored_position_ || stored_position_->keep(description_, position, zero_counts, numbers)) return;
  note(stored_position_->path() + " cannot be written, so the next command will not know the machine's position");
}

// A line that was lost changes nothing of what is written: the board counts on. A board that has stopped its motors at
// once tells that itself.
void MachineConnection::keep_place() {
  const auto& zero_counts = session_ ? session_->zero_counts() : std::nullopt;
  const MachineStatus status = session_ ? session_->status() : MachineStatus();
  if (!greeted_ || !zero_counts || status.trouble) return;
  write_down(status.position, *zero_counts, numbers_);
}

bool MachineConnection::ask_first(const std::string& address, bool may_move, int& code) {
  if (const auto status = ask_status(session_->board(), first_answer)) {
    before_ = *status;
    if ((status->state & board_manual) != 0) {
      code = fail(exit_failed, fmt::format("{}: {}", address, message_of(LinkError::manual)));
      return false;
    }
    const auto about = ask_about(session_->board(), answer);
    const std::string reason = about ? unsuited_to(description_.board, *about) : "it no longer answers";
    if (!reason.empty()) {
      code = fail(exit_failed, fmt::format("{}: {}", address, reason));
      return false;
    }
    if (may_move || (status->state & board_moves) == 0) return true;
    code = fail(exit_failed, address + ": it is moving: another program is using it, or has just left it");
    return false;
  }
  // The greeting has kept its form in all versions: what does not answer a question may answer that.
  BoardSession greeting(*port_, {.answer_within = Seconds(0.25), .patience = Seconds(1)});
  passo::greet(greeting, {.motors = description_.motor_count()});
  const LinkError error = greeting.error().value_or(LinkError::wrong_version);
  const bool is_sent_away = error == LinkError::no_answer && greeting.hung_up();
  code = fail(exit_failed, fmt::format("{}: {}", address,
                                       is_sent_away ? "it closes the connection: another program uses it [board.in-use]"
                                                    : message_of(error)));
  return false;
}

std::optional<std::string> MachineConnection::wait_for_rest() {
  if (const auto status = ask_status_at_rest(session_->board(), answer)) {
    before_ = *status;
    return {};
  }
  if (!session_->board().status()) return "it no longer answers";
  return fmt::format("it is still moving after {:g} s, so another program is using it", longest_way_to_rest.value());
}

bool MachineConnection::greet(const Greeting& greeting, int& code) {
  BoardMachineSession& session = *session_;
  const KnownPosition position = session.status().position;
  numbers_ = {.session_before = before_.session,
              .executed_before = before_.executed,
              .greeting = greeting.number,
              .session = greeting.session};
  write_down(position, zero_counts_of(description_, before_, position.place), numbers_);
  greeted_ = true;
  frames_asked_ = session.board().frames_sent();
  bytes_asked_ = session.board().bytes_sent();
  session.greet(greeting);
  while (session.state() == MachineState::offline) session.poll(endless);
  const MachineState state = session.state();
  if (state == MachineState::idle || state == MachineState::door) return true;
  code = fail(exit_failed, "the board: " + session.trouble_words());
  return false;
}

void MachineConnection::begin_session(std::uint16_t number) {
  const BoardStatus& status = *session_->board().status();
  numbers_ = {.session_before = status.session, .executed_before = status.executed, .greeting = 0, .session = number};
  keep_place();
  session_->name_session(number);
}

bool MachineConnection::name_session(std::uint16_t number, int& code) {
  begin_session(number);
  if (await(session_->board(), [&] { return session_->board().ready(); })) return true;
  code = fail(exit_failed, "the board: it no longer answers");
  return false;
}

void MachineConnection::follow(Watchers& watchers, const Point& place) {
  if (!has_board()) return;
  machine_.stand_at(steps_at(description_, place));
  shadow_ = std::make_unique<BoardSession>(machine_);
  passo::greet(*shadow_, {.motors = static_cast<std::uint8_t>(description_.axes.size())});
  watchers.executed = [this](const LinkItem& item) { send(*shadow_, item); };
}

void MachineConnection::catch_up() {
  if (shadow_) drain(*shadow_);
}

std::optional<std::string> MachineConnection::compare() {
  if (const auto& mismatch = session_->mismatch()) {
    return fmt::format("motor {} is {} from machine zero, but {} were planned", mismatch->motor + 1,
                       counted(mismatch->counted, "step"), mismatch->commanded);
  }
  if (!has_board() || !plant_is_behind_ || rotors_ != nullptr) return {};
  const MachineCounts planned = machine_.counts();
  const Truth truth = plant_->truth_at(session_->now());
  for (std::size_t motor = 0; motor < description_.axes.size(); ++motor) {
    const auto steps = std::llround(truth.positions[motor]);
    if (steps == planned.motors[motor].position) continue;
    return fmt::format("motor {} has really moved to {} from machine zero, but {} were planned", motor + 1,
                       counted(steps, "step"), planned.motors[motor].position);
  }
  return {};
}

std::string place_words(const MachineDescription& machine, const Point& place) {
  std::string words;
  for (const AxisDescription& axis : machine.axes) {
    words += fmt::format("{}{}{:.3f}", words.empty() ? "" : " ", letter_of(axis.axis), place[axis.axis]);
  }
  return words;
}

std::string describe(const Refusal& refusal) {
  return fmt::format("{} [{}]", refusal.message(), code_of(refusal.code()));
}

void try_request(MachineSession& session, Request wanted) {
  static_cast<void>(session.request(std::move(wanted)).has_value());
}

void poll_until_end(MachineConnection& machine, const std::function<void()>& look) {
  BoardMachineSession& session = machine.session();
  LinkMonitor line = link_monitor();
  bool asked_to_stop = false;
  while (session.busy()) {
    if (interrupted_by() != 0 && !std::exchange(asked_to_stop, true)) {
      try_request(session, request::Stop{});
    }
    session.poll(machine.is_on_a_line() ? LinkMonitor::between_looks : endless);
    if (machine.is_on_a_line()) line.update(session.board());
    if (look) look();
  }
}

}  // namespace passo
