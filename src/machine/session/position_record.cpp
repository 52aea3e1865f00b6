#include "passo/session/position_record.hpp"

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/base/fingerprint.hpp"
#include "passo/journal/record_text.hpp"
#include "passo/kinematics/kinematics.hpp"

namespace passo {
namespace {

constexpr std::string_view title = "passo place 1\n";

std::optional<Trust> read_trust(RecordWords& words) {
  const auto value = words.number<unsigned>();
  return value <= static_cast<unsigned>(Trust::homed) ? std::optional(static_cast<Trust>(value)) : std::nullopt;
}

bool is_of(const PositionRecord& record, const MachineDescription& machine) {
  return record.machine == place_fingerprint(machine) && record.zero_counts.size() == machine.axes.size();
}

// Why the board is not the one of the record, if it is not. A board that was never greeted looks like one that was
// reset, so it is not believed even if it seems to wait for its first hello.
std::optional<PositionDoubt> refuse_board(const SessionNumbers& numbers, const BoardStatus& status) {
  using Stage = SessionNumbers::Stage;
  const Stage stage = numbers.stage_of(status, true);
  const bool is_fresh = stage == Stage::before_hello && numbers.session_before == 0;
  if (stage != Stage::another && !is_fresh) return {};
  if (status.session != 0) return PositionDoubt::other_session;
  return status.motors == 0 ? PositionDoubt::board_reset : PositionDoubt::session_ended;
}

}  // namespace

std::uint64_t place_fingerprint(const MachineDescription& machine) {
  Fingerprint fingerprint;
  const Kinematics kinematics = kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    for (const AxisRow::Share& share : kinematics.rows()[m].steps.shares()) {
      fingerprint.add(std::uint64_t{static_cast<unsigned char>(letter_of(share.axis))});
      fingerprint.add(share.factor);
    }
    if (axis.screw && axis.screw->is_compensated) {
      fingerprint.add(axis.screw->backlash);
      for (const ScrewDescription::Error& error : axis.screw->errors) {
        fingerprint.add(error.at);
        fingerprint.add(error.off);
      }
    }
    if (axis.second) {
      fingerprint.add(std::uint64_t{axis.second->inverted});
      fingerprint.add(axis.second->square);
    }
    if (!axis.home) continue;
    fingerprint.add(axis.home->switch_at);
    fingerprint.add(std::uint64_t{axis.home->toward_high});
  }
  return fingerprint.value();
}

std::string text_of(const PositionRecord& record) {
  std::string text(title);
  text += fmt::format("machine {:016x}\ntrust {}\nzero {}", record.machine, static_cast<unsigned>(record.trust),
                      record.zero_counts.size());
  for (const int count : record.zero_counts) text += fmt::format(" {}", count);
  const SessionNumbers& numbers = record.numbers;
  text += fmt::format("\nbefore {} {}\nsession {} {}\n", numbers.session_before, numbers.executed_before,
                      numbers.greeting, numbers.session);
  if (record.is_lost) text += "lost\n";
  end_record(text);
  return text;
}

std::optional<PositionRecord> read_place_record(std::string_view text) {
  const std::optional<RecordParts> parts = read_record(text, title);
  if (!parts) return {};
  RecordWords words(parts->body);
  PositionRecord record;
  words.expect("machine");
  record.machine = words.number<std::uint64_t>(16);
  words.expect("trust");
  const std::optional<Trust> trust = read_trust(words);
  words.expect("zero");
  const auto motors = words.number<std::size_t>();
  if (!trust || motors > max_motors) return {};
  record.trust = *trust;
  for (std::size_t m = 0; m < motors; ++m) record.zero_counts.push_back(words.number<int>());
  words.expect("before");
  record.numbers.session_before = words.number<std::uint16_t>();
  record.numbers.executed_before = words.number<std::uint16_t>();
  words.expect("session");
  record.numbers.greeting = words.number<std::uint8_t>();
  record.numbers.session = words.number<std::uint16_t>();
  record.is_lost = words.good() && !words.at_end();
  if (record.is_lost) words.expect("lost");
  if (!words.good() || !words.at_end() || record.numbers.session == 0) return {};
  return record;
}

std::string_view message_of(PositionDoubt doubt) {
  switch (doubt) {
    case PositionDoubt::no_record: return "it was never homed, and its position was never confirmed";
    case PositionDoubt::other_machine: return "the machine file is different, or was changed";
    case PositionDoubt::board_reset: return "its board was reset or switched off";
    case PositionDoubt::other_session: return "another program was run on its board";
    case PositionDoubt::session_ended:
      return "it was moved with the board's keypad, or another program connected to the board";
    case PositionDoubt::drivers_off:
      return "its board disabled the drivers after a time without a host (drivers_off_after_s), and the axes may have "
             "moved";
    case PositionDoubt::stopped_at_once: return "its motors were stopped instantly and may have lost steps";
  }
  return "its position is uncertain";
}

std::optional<Point> counted_place(const std::optional<PositionRecord>& record, const MachineDescription& machine,
                                   const BoardStatus& status) {
  if (!record || !is_of(*record, machine) || refuse_board(record->numbers, status)) return {};
  return kinematics_of(machine).axes(steps_since(record->zero_counts, status.positions));
}

Result<KnownPosition, PositionDoubt> place_of(const std::optional<PositionRecord>& record,
                                              const MachineDescription& machine, const BoardStatus& status) {
  if (!record || record->trust == Trust::unknown) return Failure{PositionDoubt::no_record};
  if (!is_of(*record, machine)) return Failure{PositionDoubt::other_machine};
  if (const auto refused = refuse_board(record->numbers, status)) return Failure{*refused};
  if ((status.state & board_trusted) == 0) {
    const bool let_go = (status.inputs & drivers_timed_out) != 0;
    return Failure{let_go ? PositionDoubt::drivers_off : PositionDoubt::stopped_at_once};
  }
  return KnownPosition{.place = counted_place(record, machine, status).value_or(Point()), .trust = record->trust};
}

}  // namespace passo
