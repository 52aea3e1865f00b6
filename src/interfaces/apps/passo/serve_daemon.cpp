#include "serve_daemon.hpp"

#include <algorithm>
#include <utility>

#include "machine_connection.hpp"
#include "run_signals.hpp"
#include <poll.h>

namespace passo {
namespace {

// How long the loop waits for senders and clients: while the machine is busy, and while nothing goes on.
constexpr Seconds busy_look{0.002};
constexpr Seconds idle_look{0.02};
constexpr Seconds hardly_late{1e-4};
constexpr int most_turns = 5000;  // of one look

}  // namespace

ServeDaemon::ServeDaemon(ServedMachine machine, GrblController& grbl, MachineControl& owner, Lines lines,
                         ServedWeb* web, ServiceNotice& service)
    : machine_(std::move(machine)),
      session_(machine_.session),
      grbl_(grbl),
      owner_(owner),
      lines_(std::move(lines)),
      web_(web),
      service_(service),
      clock_(machine_.speed) {}

void ServeDaemon::serve() {
  while (interrupted_by() == 0) {
    wait();
    for (const auto& line : lines_) attend(*line);
    if (web_ != nullptr) web_->poll();
    if (pendant_ != nullptr) pendant_->poll();
    check_owner();
    poll();
    keep_place_if_changed();
    reply();
    if (status_ != nullptr) status_->poll(session_, web_ != nullptr ? &web_->api() : nullptr);
    service_.alive();
  }
}

void ServeDaemon::stop() {
  if (web_ != nullptr) web_->leave();
  if (BoardStorage* const storage = session_.storage()) storage->cancel();
  if (session_.busy()) try_request(session_, request::Stop{});
  while (session_.busy()) {
    session_.poll(machine_.has_board ? busy_look : Seconds(1));
    service_.alive();
  }
  hear_changes();
}

// While the machine is busy, its board is waited for in poll(). A look that may not sleep would only cost: each socket
// of each client is looked at again.
void ServeDaemon::wait() {
  if (session_.works() && machine_.has_board) return;
  Seconds most = session_.works() ? busy_look : idle_look;
  if (web_ != nullptr) most = web_->most_wait(most);
  if (most == Seconds(0)) return;
  std::vector<pollfd> all;
  for (const auto& line : lines_) line->add_to(all, may_read(*line));
  if (web_ != nullptr) web_->add_to(all);
  if (pendant_ != nullptr) pendant_->add_to(all);
  static_cast<void>(::poll(all.data(), all.size(), static_cast<int>(most.value() * 1e3)));
}

// One sender at a time; others are told that they have to wait.
bool ServeDaemon::may_read(const SenderConnection& line) const {
  return grbl_.wants_more() && (driver_ == nullptr || driver_ == &line);
}

// A sender on a serial port may have gone without a sign. While nothing goes on, it gives way to another.
void ServeDaemon::check_silent_driver(const SenderConnection& line) {
  if (driver_ == nullptr || driver_ == &line || !line.is_connected()) return;
  if (!driver_->yields() || session_.busy()) return;
  driver_->part();
  driver_ = nullptr;
  grbl_.disconnect();
}

void ServeDaemon::attend(SenderConnection& line) {
  const SenderConnection::News news = line.poll(may_read(line));
  check_silent_driver(line);
  if (line.is_connected() && driver_ == nullptr) {
    driver_ = &line;
    driver_spoke_ = false;
    grbl_.let_drive(owner_.kind() != MachineControl::Kind::client);
    grbl_.connect();
  }
  if (driver_ != &line) return;
  if (!news.bytes.empty()) {
    if (!std::exchange(driver_spoke_, true)) check_owner();
    grbl_.receive(news.bytes);
  }
  if (!news.went) return;
  driver_ = nullptr;
  if (driver_spoke_) grbl_.disconnect();
}

// A sender has the motion that nobody else wants. One who has gone keeps nothing. Whoever has said nothing yet may be a
// browser, and has nothing.
void ServeDaemon::check_owner() {
  if (driver_ != nullptr && driver_spoke_) {
    owner_.claim_for_sender();
  } else if (owner_.is_sender()) {
    owner_.release();
  }
  // A sender's held program waits for the next sender, unless a client comes.
  if (owner_.kind() != MachineControl::Kind::nobody) grbl_.let_drive(owner_.is_sender());
}

void ServeDaemon::hear_changes() {
  const std::vector<MachineChange> changes = session_.take_changes();
  grbl_.poll(changes);
  if (web_ != nullptr) web_->hear_changes(changes);
}

void ServeDaemon::poll() {
  if (machine_.has_board) {
    session_.poll(session_.works() ? busy_look : Seconds(0));
    return hear_changes();
  }
  for (int turns = 0; turns < most_turns; ++turns) {
    const Seconds ahead = clock_.ahead_of(session_.now());
    if (ahead < hardly_late) break;
    session_.poll(ahead);
    hear_changes();
  }
  hear_changes();
}

// Homing, or a person, may have said where the machine stands. Whoever kills the daemon then takes nothing of it away.
void ServeDaemon::keep_place_if_changed() {
  const std::uint64_t version = session_.status().version;
  if (session_.works() || std::exchange(kept_version_, version) == version) return;
  machine_.keep_place();
}

void ServeDaemon::reply() {
  for (const std::string& text : grbl_.take_replies()) {
    if (driver_ != nullptr) driver_->send(text);
  }
}

}  // namespace passo
