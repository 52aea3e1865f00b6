#include "passo/sender/grbl_sender.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/base/utf8.hpp"

namespace passo {
namespace {

constexpr Seconds start_of_an_arduino{2};
constexpr Seconds quiet{0.3};  // after a line end, so that the answers to what was left are over
constexpr Seconds longest_braking{10};
constexpr Seconds longest_drop{3};
// Another sender's reports may come all the time.
constexpr Seconds longest_clearing{2};
// A spindle is waited for in the state Idle, by grblHAL and FluidNC.
constexpr Seconds longest_spindle_start{30};
constexpr std::size_t longest_reply = 4096;
constexpr Seconds between_override_bytes{0.02};
constexpr Seconds longest_report_on_its_way{0.5};
constexpr char soft_reset = 0x18;
constexpr std::string_view more_answers =
    "the machine has answered more lines than it was sent: a line was doubled or corrupted on the way";
constexpr std::string_view homing_line = "$H\n";

std::optional<int> read_code(std::string_view text) {
  const auto number = read_grbl_number(text);
  if (!number || std::abs(*number) > 1e6) return {};
  return static_cast<int>(*number);
}

// What a board says reaches terminals and JSON: control characters, and bytes that are not UTF-8, become question
// marks.
std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const CodePoint first = first_code_point(text);
    const std::size_t length = std::max<std::size_t>(first.length, 1);
    const bool is_low = first.value < 0x20 && first.value != '\t';  // grblHAL divides fields by tabs
    const bool is_control = first.length == 0 || is_low || (first.value >= 0x7f && first.value < 0xa0);
    if (is_control) {
      shown += '?';
    } else {
      shown += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return shown;
}

std::string_view without_blanks(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

// The bytes that lead to a percentage, wherever the machine is now: 100 first, then steps of 10 and of 1.
std::string steps_to(int wanted, char hundred, char ten_up) {
  wanted = std::clamp(wanted, 10, 200);
  std::string bytes(1, hundred);
  int now = 100;
  const auto steps = [&](int size, char up, char down) {
    for (; std::abs(wanted - now) >= size; now += wanted > now ? size : -size) bytes += wanted > now ? up : down;
  };
  steps(10, ten_up, static_cast<char>(ten_up + 1));
  steps(1, static_cast<char>(ten_up + 2), static_cast<char>(ten_up + 3));
  return bytes;
}

}  // namespace

GrblSender::GrblSender(Seconds now) : now_(now) {
  last_.begun = last_.stage = last_.heard = last_.polled = now;
}

GrblSender GrblSender::on_open_line(Seconds now) {
  GrblSender sender(now);
  sender.last_.stage = now - start_of_an_arduino;
  return sender;
}

void GrblSender::ask_for_offsets() {
  if (machine_.settings.empty()) add("$$");
  add("$#");
  add("$G");
}

std::string GrblSender::alarm_words() const {
  const bool has_number = report() && report()->state == "Alarm" && report()->detail > 0;
  return locked_by_.empty() && has_number ? words_of_alarm(report()->detail) : locked_by_;
}

std::string_view GrblSender::waits_for() const {
  if (stage_ != Stage::ready || is_held_ || !report()) return {};
  return words_of_grbl_wait(*report());
}

void GrblSender::add(std::string text, std::uint32_t line, Seconds silence) {
  if (text.starts_with('M')) silence = std::max(silence, longest_spindle_start);
  std::vector<std::string> pieces;
  if (follower_) pieces = follower_->pieces(text);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    window_.add({.text = pieces[i] + '\n', .line = line, .goes_on = true});
  }
  if (!pieces.empty()) text = std::move(pieces.back());
  text += '\n';
  window_.add({.text = std::move(text), .line = line, .silence = silence});
}

void GrblSender::ask(std::string text, Seconds silence) {
  text += '\n';
  window_.add({.text = std::move(text), .silence = silence, .asks = true});
}

void GrblSender::hold() {
  is_held_ = true;
  act('!');
}

void GrblSender::resume() {
  is_held_ = false;
  act('~');
}

void GrblSender::override_feed(int percent) {
  override_.feed = std::clamp(percent, 10, 200) / 100.0;
  override_.told.reset();
  if (follower_) follower_->set_override(override_.feed);
  for (const char byte : steps_to(percent, '\x90', '\x91')) override_.bytes.push_back(byte);
}

void GrblSender::override_spindle(int percent) {
  override_.told.reset();
  for (const char byte : steps_to(percent, '\x99', '\x9A')) override_.bytes.push_back(byte);
}

// One by one: Grbl counts equal bytes once that come before it has looked.
void GrblSender::send_overrides() {
  if (override_.bytes.empty() || now_ - override_.sent < between_override_bytes) return;
  act(override_.bytes.front());
  override_.bytes.pop_front();
  override_.sent = now_;
}

int GrblSender::override_rapids(int percent) {
  const int level = percent > 75 ? 0 : percent > 37 ? 1 : 2;
  act(static_cast<char>('\x95' + level));
  override_.told.reset();
  override_.sent = now_;
  return 100 >> level;
}

// A report that was on its way when a byte was sent does not know it.
void GrblSender::hear_overrides(const GrblReport& report) {
  if (!report.overrides || !override_.bytes.empty() || now_ - override_.sent < longest_report_on_its_way) return;
  override_.told = report.overrides;
  override_.feed = std::max(report.overrides->feed, 1) / 100.0;
  if (follower_) follower_->set_override(override_.feed);
}

void GrblSender::cancel_jog() {
  window_.drop_waiting();
  act('\x85');
}

void GrblSender::reset() {
  window_.drop_waiting();
  act(soft_reset);
  enter(Stage::dropping);
}

void GrblSender::stop() {
  if (stops() || stopped()) return;
  window_.drop_waiting();
  // Homing hears no hold, and the place is not known anyway.
  if (window_.oldest() != nullptr && window_.oldest()->text == homing_line) {
    act(soft_reset);
    return enter(Stage::dropping);
  }
  enter(Stage::braking);
  last_.asked = Seconds(-1);
  reports_.outdate();
  act('!');
}

void GrblSender::lose() {
  end_with(fault_between_lines(
      "grbl.line-lost", "the connection was lost. The machine finishes the motion in its buffer, and then stops"));
}

void GrblSender::enter(Stage stage) {
  stage_ = stage;
  last_.stage = now_;
}

// What the machine may be executing: the planner's blocks that are not free. An arc takes many, so the line may be a
// later one, but no earlier one.
std::uint32_t GrblSender::first_held_line() const {
  std::size_t held = machine_.blocks;
  if (report() && report()->blocks_free) held = machine_.blocks - std::min(machine_.blocks, *report()->blocks_free);
  // What was answered after the report is held too, perhaps.
  return window_.first_held(held + 4);
}

void GrblSender::fail(GrblFault fault) {
  if (!fault_) fault_ = std::move(fault);
}

void GrblSender::end_with(GrblFault fault) {
  fail(std::move(fault));
  window_.drop_waiting();
  stage_ = Stage::stopped;
}

GrblFault GrblSender::fault_between_lines(std::string code, std::string message) const {
  return {.code = std::move(code),
          .message = std::move(message),
          .first_line = first_held_line(),
          .last_line = window_.last_line()};
}

void GrblSender::ask_for_status() {
  const Seconds pause = stops() || looks_often_ ? between_urgent_questions : between_questions;
  if (last_.asked >= Seconds(0) && now_ - last_.asked < pause) return;
  last_.asked = now_;
  act('?');
}

void GrblSender::poll(Seconds now) {
  // While this program stood still, nothing could be heard.
  if (now - last_.polled > Seconds(0.5)) last_.heard = std::max(last_.heard, now - Seconds(0.5));
  now_ = last_.polled = now;
  send_overrides();
  switch (stage_) {
    case Stage::waking:
    case Stage::clearing:
    case Stage::looking:
    case Stage::asking: return greet();
    case Stage::ready: return watch();
    case Stage::braking: return brake();
    case Stage::dropping:
      if (now - last_.stage > longest_drop) stage_ = Stage::stopped;
      return;
    case Stage::stopped: return;
  }
}

void GrblSender::greet() {
  if (now_ - last_.begun > longest_greeting) return end_with(fault_of_greeting());
  switch (stage_) {
    case Stage::waking:
      if (now_ - last_.stage < start_of_an_arduino) return;
      enter(Stage::clearing);
      urgent_ += '\n';  // ends a line that another sender has left
      return;
    case Stage::clearing:
      if (now_ - std::max(last_.heard, last_.stage) < quiet && now_ - last_.stage < longest_clearing) return;
      enter(Stage::looking);
      last_.heard = now_;
      reports_.forget_last();
      return;
    case Stage::looking:
      // The state is told in each state; lines are answered in few.
      ask_for_status();
      if (!report()) return check_silence();
      if (auto trouble = trouble_of_grbl_state(*report())) return end_with(std::move(*trouble));
      enter(Stage::asking);
      add("$I");
      return ask_for_offsets();
    default:
      if (all_answered()) {
        while (window_.take_reply()) continue;
        std::vector<std::string> questions = machine_.take_questions();
        if (questions.empty()) return enter(Stage::ready);
        for (std::string& question : questions) ask(std::move(question));
      }
      ask_for_status();
      check_lost_bytes();
      return check_silence();
  }
}

void GrblSender::watch() {
  ask_for_status();
  // It cannot come out of these by itself.
  if (report()->state == "Sleep" || report()->state == "Check") {
    GrblFault trouble = *trouble_of_grbl_state(*report());
    return end_with(fault_between_lines(std::move(trouble.code), std::move(trouble.message)));
  }
  check_lost_bytes();
  if (stage_ == Stage::ready) check_standstill();
  if (stage_ == Stage::ready) check_silence();
}

void GrblSender::brake() {
  ask_for_status();
  // A hold at rest, or nothing to hold. A dwell is no motion and is not held: it rests too.
  const bool rests = reports_.came_after(last_.stage) && report()->rests();
  if (!rests && now_ - last_.stage < longest_braking) return;
  act(soft_reset);
  enter(Stage::dropping);
}

std::string GrblSender::take_bytes(Seconds now) {
  poll(now);
  std::string bytes = std::exchange(urgent_, {});
  const bool may_send = (stage_ == Stage::asking || stage_ == Stage::ready) && !fault_;
  if (!may_send) return bytes;
  return bytes + (follower_ ? send_lines(now) : window_.send(now, machine_.bytes));
}

void GrblSender::receive(std::string_view bytes, Seconds now) {
  now_ = now;
  if (!bytes.empty()) last_.heard = now;
  for (const char byte : bytes) {
    if (byte != '\n' && byte != '\r') {
      if (came_.size() < longest_reply) came_ += byte;
      continue;
    }
    if (!came_.empty()) hear(std::exchange(came_, {}));
  }
}

void GrblSender::hear(std::string_view line) {
  constexpr std::string_view error = "error:";
  constexpr std::string_view alarm_head = "ALARM:";
  const std::string_view unread = line;
  const std::string with_blanks = printable(line);
  line = without_blanks(with_blanks);
  if (const auto report = read_grbl_report(line, machine_.axes)) return hear_report(*report);
  last_.told = now_;
  last_line_heard_ = without_blanks(unread);
  if (is_report_of_old_grbl(line) || line.starts_with("Grbl 0.")) {
    return end_with({.code = "grbl.too-old",
                     .message = "the machine has a Grbl older than 1.1, which Passo does not support: flash Grbl 1.1",
                     .first_line = 0,
                     .last_line = 0});
  }
  if (is_grbl_greeting(line)) {
    machine_.hear_greeting(line);
    return hear_greeting();
  }
  if (line == "ok") return answer({});
  if (line.starts_with(error)) {
    const bool is_answer = window_.oldest() != nullptr;
    answer(without_blanks(line.substr(error.size())));
    if (!is_answer && listener_) listener_(line);  // e.g. of a line in a file that the board runs
    return;
  }
  if (line.starts_with(alarm_head)) return alarm(without_blanks(line.substr(alarm_head.size())));
  if (follower_ && line.starts_with("[GC:") && line.ends_with(']')) hear_modes(line.substr(4, line.size() - 5));
  machine_.hear(line);
  window_.note_said(with_blanks);
  if (listener_) listener_(line);
}

void GrblSender::hear_report(const GrblReport& report) {
  ++reports_heard_;
  if (greets()) machine_.hear_value_count(report.values);
  if (reports_.hear(report, now_)) last_.progress = now_;
  if (report.bytes_free) window_.hear_free_bytes(*report.bytes_free);
  hear_overrides(report);
  follow_report(report);
}

void GrblSender::hear_greeting() {
  switch (stage_) {
    case Stage::waking: last_.stage = now_ - start_of_an_arduino; return;
    case Stage::clearing:
    case Stage::stopped: return;
    case Stage::looking:
    case Stage::asking:
      // A board that starts for longer than an Arduino does. It has not heard the questions, or has forgotten them.
      window_.drop_waiting();
      window_.drop_sent();
      machine_.version.clear();
      return enter(Stage::clearing);
    case Stage::dropping:
      window_.drop_sent();
      stage_ = Stage::stopped;
      return;
    case Stage::ready:
    case Stage::braking: break;
  }
  end_with(fault_between_lines(
      "grbl.restarted", "the machine restarted (reset button, power or another program). Its position may be lost"));
  window_.drop_sent();
}

void GrblSender::answer(std::optional<std::string_view> error) {
  if (window_.oldest() == nullptr) {  // of what another sender has left
    if (follower_ && stage_ == Stage::ready && has_work()) fail_and_stop("grbl.lost-lines", std::string(more_answers));
    return;
  }
  // The same, if it comes late: the answer to $I tells the version.
  if (stage_ == Stage::asking && machine_.version.empty()) return;
  UnacknowledgedLines::Line line = *window_.take_answered();
  last_.answered = last_.progress = now_;
  if (line.marks) return answer_mark();
  if (line.asks) return window_.keep_reply(std::move(line), error ? words_of_error(*error) : "");
  if (!error) {
    window_.note_held(line.line, machine_.blocks + 8);
    return;
  }
  // In some alarms it answers few questions. They are asked again.
  if (stage_ == Stage::asking && report()->state == "Alarm") return;
  fail({.code = "grbl.error",
        .message = fmt::format("the machine rejects \"{}\": {}", UnacknowledgedLines::without_end(line.text),
                               words_of_error(*error)),
        .first_line = line.line,
        .last_line = line.line});
  // What follows is in the machine already. It must not go on without the refused line.
  if (has_work() && stage_ == Stage::ready) stop();
}

std::string GrblSender::words_of_error(std::string_view error) const {
  const auto number = read_code(error);
  if (!number) return fmt::format("error:{}", error);
  return fmt::format("error:{}, {}", error, words_of_grbl_error(machine_.firmware, *number));
}

std::string GrblSender::words_of_alarm(int number) const {
  const auto own = machine_.alarms.find(number);
  const bool is_known = !meaning_of_grbl_alarm(machine_.firmware, number).empty();
  const std::string_view words = is_known || own == machine_.alarms.end()
                                     ? words_of_grbl_alarm(machine_.firmware, number)
                                     : std::string_view(own->second);
  return fmt::format("ALARM:{}, {}", number, words);
}

void GrblSender::alarm(std::string_view text) {
  const auto number = read_code(text);
  std::string words = number ? words_of_alarm(*number) : fmt::format("ALARM: {}", text);
  if (greets()) {
    locked_by_ = std::move(words);
  } else {
    end_with(fault_between_lines("grbl.alarm", std::move(words)));
  }
}

}  // namespace passo
