#include "served_pendant.hpp"

#include <utility>

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/session/board_machine_session.hpp"
#include "passo/toml/toml_reporter.hpp"

namespace passo {
namespace {

constexpr int most_reports = 64;  // of one look: a device that sends without end does not stop the machine's loop

constexpr Seconds handwheel_answer{1};

// The table of the machine file describes a handwheel that the board does not have.
void show_missing_handwheel(const ServeArguments& arguments, const HandwheelDescription& wheel,
                            const std::string& text) {
  Diagnostics diagnostics;
  const TomlReporter reporter(text, arguments.machine, diagnostics, {.area = "board"});
  reporter.error("board.no-handwheel", wheel.place,
                 fmt::format("the board {} has no pins for a handwheel", arguments.board),
                 "a Pico with the image pico_mpg; for another board, remove this table");
  show(diagnostics);
}

}  // namespace

std::unique_ptr<ServedPendant> ServedPendant::open(const ServeArguments& arguments, const PendantMachine& machine,
                                                   PendantStatus& status, const std::string& text, int& code) {
  if (arguments.pendant.empty()) return open_handwheel(arguments, machine, status, text, code);
  Diagnostics diagnostics;
  auto finder = PendantFinder::make(arguments.pendant, arguments.system, diagnostics);
  show(diagnostics);
  if (!finder) {
    code = exit_bad_program;
    return nullptr;
  }
  std::unique_ptr<ServedPendant> pendant(new ServedPendant(std::move(*finder), machine, status));
  pendant->search();
  return pendant;
}

std::unique_ptr<ServedPendant> ServedPendant::open_handwheel(const ServeArguments& arguments,
                                                             const PendantMachine& machine, PendantStatus& status,
                                                             const std::string& text, int& code) {
  const HandwheelDescription& wheel = *machine.machine.handwheel;
  BoardMachineSession* const session = machine.session.as_board_session();
  if (session == nullptr || has_handwheel(session->board(), handwheel_answer) == false) {
    show_missing_handwheel(arguments, wheel, text);
    code = exit_bad_machine;
    return nullptr;
  }
  auto handwheel = std::make_unique<BoardHandwheel>(wheel, session->board(), machine, status);
  return std::unique_ptr<ServedPendant>(new ServedPendant(std::move(handwheel), machine, status));
}

std::string ServedPendant::name() const {
  if (handwheel_ != nullptr) return "handwheel at the pins of the board";
  return device_ != nullptr ? status_.name : "not connected yet; it may be plugged in at any time";
}

Seconds ServedPendant::now() const {
  return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

void ServedPendant::add_to(std::vector<pollfd>& all) const {
  if (device_ != nullptr) all.push_back({.fd = device_->descriptor(), .events = POLLIN, .revents = 0});
}

void ServedPendant::search() {
  if (searched_at_ && now() - *searched_at_ < between_searches) return;
  searched_at_ = now();
  const auto found = finder_->find();
  if (!found) return;
  std::string trouble;
  if (found->table == nullptr) {
    trouble = fmt::format("{}: no table describes this device ({:04x}:{:04x}) [pendant.unknown]", found->device.device,
                          found->device.vendor, found->device.product);
  } else if (auto device = open_pendant(*found)) {
    device_ = std::move(*device);
    if (std::exchange(table_, found->table) != found->table) control_.reset();
    if (control_ == nullptr) control_ = std::make_unique<PendantControl>(*found->table, machine_, status_);
    control_->connect(now());
  } else {
    trouble = device.error() + " [pendant.open]";
  }
  if (!trouble.empty() && trouble != trouble_) note("--pendant: " + trouble);
  trouble_ = trouble;
}

void ServedPendant::read() {
  for (int i = 0; i < most_reports; ++i) {
    switch (device_->read(report_)) {
      case PendantDevice::Read::report: control_->receive(report_, now()); break;
      case PendantDevice::Read::nothing: return;
      case PendantDevice::Read::gone: return lose();
    }
  }
}

void ServedPendant::lose() {
  device_.reset();
  control_->disconnect(now());
}

void ServedPendant::poll() {
  if (handwheel_ != nullptr) return handwheel_->poll(now());
  if (device_ == nullptr) {
    search();
  } else {
    read();
  }
  if (control_ == nullptr) return;
  control_->poll(now());
  auto reports = control_->take_display(now());
  if (device_ != nullptr && !reports.empty()) device_->show(std::move(reports));
}

}  // namespace passo
