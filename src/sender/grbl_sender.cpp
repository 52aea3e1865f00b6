#include "passo/sender/grbl_sender.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr Seconds start_of_an_arduino{2};
constexpr Seconds quiet{0.3};  // after a line end, so that the answers to what was left are over
constexpr Seconds longest_braking{10};
constexpr Seconds longest_drop{3};
// A machine that is idle for so long, with lines that it has not answered, has not got them.
constexpr Seconds longest_idle{2};
constexpr std::size_t longest_reply = 4096;
constexpr char soft_reset = 0x18;

std::optional<int> number_after(std::string_view line, std::string_view head) {
  if (!line.starts_with(head)) return {};
  line.remove_prefix(head.size());
  int value = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || end != line.data() + line.size()) return {};
  return value;
}

std::string without_end(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

// The bytes that lead from one percentage to another: 100 first, where that is nearer, then steps of 10 and of 1.
std::string steps_to(int& now, int wanted, char hundred, char ten_up) {
  wanted = std::clamp(wanted, 10, 200);
  std::string bytes(1, hundred);
  now = 100;
  const auto steps = [&](int size, char up, char down) {
    for (; std::abs(wanted - now) >= size; now += wanted > now ? size : -size) bytes += wanted > now ? up : down;
  };
  steps(10, ten_up, static_cast<char>(ten_up + 1));
  steps(1, static_cast<char>(ten_up + 2), static_cast<char>(ten_up + 3));
  return bytes;
}

}  // namespace

bool GrblMachine::in_inches() const {
  const auto found = settings.find(13);
  return found != settings.end() && found->second != 0;
}

GrblSender::GrblSender(Seconds now) : now_(now), stage_since_(now), heard_(now) {}

std::optional<Point> GrblSender::place() const {
  if (!report_) return {};
  if (report_->machine_place) return *report_->machine_place * unit();
  if (!report_->work_place || !offset_) return {};
  return (*report_->work_place + *offset_) * unit();
}

void GrblSender::add(std::string text, std::uint32_t line, Seconds silence) {
  text += '\n';
  waiting_.push_back({.text = std::move(text), .line = line, .silence = silence});
}

bool GrblSender::at_rest() const {
  return all_answered() && report_ && report_->state == "Idle" && reported_ > answered_;
}

void GrblSender::override_feed(int percent) {
  urgent_ += steps_to(feed_percent_, percent, '\x90', '\x91');
}

void GrblSender::override_rapids(int percent) {
  act(percent > 75 ? '\x95' : percent > 37 ? '\x96' : '\x97');
}

void GrblSender::override_spindle(int percent) {
  urgent_ += steps_to(spindle_percent_, percent, '\x99', '\x9A');
}

void GrblSender::stop() {
  if (stops() || stopped()) return;
  waiting_.clear();
  stage_ = Stage::braking;
  stage_since_ = now_;
  asked_ = Seconds(-1);
  reported_ = Seconds(-1);
  act('!');
}

void GrblSender::lose() {
  fail({.code = "grbl.line-lost",
        .message = "the line is gone. The machine finishes what it holds, and then rests",
        .first_line = first_held_line(),
        .last_line = last_line_});
  waiting_.clear();
  stage_ = Stage::stopped;
}

// What the machine may be executing: the planner's blocks that are not free. An arc takes many, so the line may be a
// later one, but no earlier one.
std::uint32_t GrblSender::first_held_line() const {
  std::size_t held = machine_.blocks;
  if (report_ && report_->blocks_free) held = machine_.blocks - std::min(machine_.blocks, *report_->blocks_free);
  // What was answered after the report is held too, perhaps.
  held = std::min(std::max<std::size_t>(held + 4, 1), held_lines_.size());
  return held == 0 ? last_line_ : held_lines_[held_lines_.size() - held];
}

void GrblSender::fail(GrblFault fault) {
  if (!fault_) fault_ = std::move(fault);
}

Seconds GrblSender::patience() const {
  return longest_silence + (unanswered_.empty() ? Seconds(0) : unanswered_.front().silence);
}

void GrblSender::mind_silence() {
  const Seconds since = std::max(heard_, stage_since_);
  if (now_ - since < patience()) return;
  fail({.code = "grbl.no-answer",
        .message = fmt::format("the machine has not answered for {:.0f} s", (now_ - since).value()),
        .first_line = first_held_line(),
        .last_line = last_line_});
  waiting_.clear();
  stage_ = Stage::stopped;
}

// Bytes that a bad line has swallowed are never answered.
void GrblSender::mind_lost_bytes() {
  const bool is_idle = report_ && report_->state == "Idle";
  if (!is_idle || unanswered_.empty()) {
    idle_since_ = now_;
    return;
  }
  const Seconds since = std::max({idle_since_, unanswered_.front().sent, answered_});
  // By its reports, not by the clock: a machine that is silent is not idle.
  if (reported_ - since < longest_idle + unanswered_.front().silence) return;
  fail({.code = "grbl.lost-bytes",
        .message = fmt::format("the machine is idle and has not answered \"{}\": bytes were lost on the line",
                               without_end(unanswered_.front().text)),
        .first_line = unanswered_.front().line,
        .last_line = unanswered_.front().line});
  stop();
}

void GrblSender::ask_for_status() {
  const Seconds pause = stops() ? between_urgent_questions : between_questions;
  if (asked_ >= Seconds(0) && now_ - asked_ < pause) return;
  asked_ = now_;
  act('?');
}

void GrblSender::turn(Seconds now) {
  now_ = now;
  switch (stage_) {
    case Stage::waking:
      if (now - stage_since_ < start_of_an_arduino) return;
      stage_ = Stage::clearing;
      stage_since_ = now;
      urgent_ += '\n';  // ends a line that another sender has left
      return;
    case Stage::clearing:
      if (now - std::max(heard_, stage_since_) < quiet) return;
      stage_ = Stage::asking;
      stage_since_ = heard_ = now;
      for (const char* question : {"$I", "$$", "$#"}) add(question);
      return;
    case Stage::asking:
    case Stage::ready:
      ask_for_status();
      if (stage_ == Stage::asking && report_ && all_answered()) {
        stage_ = Stage::ready;
        stage_since_ = now;
      }
      mind_lost_bytes();
      return mind_silence();
    case Stage::braking: {
      ask_for_status();
      // A hold at rest, or nothing to hold. A dwell is no motion and is not held: it rests too.
      const bool rests = report_ && reported_ > stage_since_ && (report_->rests() || report_->state == "Alarm");
      if (!rests && now - stage_since_ < longest_braking) return;
      rested_for_stop_ = rests;
      act(soft_reset);
      stage_ = Stage::dropping;
      stage_since_ = now;
      return;
    }
    case Stage::dropping:
      if (now - stage_since_ > longest_drop) stage_ = Stage::stopped;
      return;
    case Stage::stopped: return;
  }
}

std::string GrblSender::take_bytes(Seconds now) {
  turn(now);
  std::string bytes = std::exchange(urgent_, {});
  const bool may_send = (stage_ == Stage::asking || stage_ == Stage::ready) && !fault_;
  while (may_send && !waiting_.empty()) {
    Line& next = waiting_.front();
    if (unanswered_bytes_ + next.text.size() > machine_.bytes) break;
    next.sent = now;
    bytes += next.text;
    unanswered_bytes_ += next.text.size();
    if (next.line != 0) last_line_ = next.line;
    has_work_ = has_work_ || next.line != 0;
    ++lines_sent_;
    unanswered_.push_back(std::move(next));
    waiting_.pop_front();
  }
  return bytes;
}

void GrblSender::receive(std::string_view bytes, Seconds now) {
  now_ = now;
  if (!bytes.empty()) heard_ = now;
  for (const char byte : bytes) {
    if (byte != '\n' && byte != '\r') {
      if (came_.size() < longest_reply) came_ += byte;
      continue;
    }
    if (!came_.empty()) hear(std::exchange(came_, {}));
  }
}

void GrblSender::hear(std::string_view line) {
  while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
  if (const auto report = read_grbl_report(line)) return hear_report(*report);
  if (line.starts_with("Grbl") || line.starts_with("GrblHAL") || line.starts_with("[FIRMWARE:")) return hear_banner();
  if (line == "ok") return answer(0);
  if (const auto error = number_after(line, "error:")) return answer(*error);
  if (const auto number = number_after(line, "ALARM:")) return alarm(*number);
  if (line.starts_with('[') && line.ends_with(']')) return hear_bracket(line.substr(1, line.size() - 2));
  if (line.starts_with('$')) hear_setting(line);
}

void GrblSender::hear_report(const GrblReport& report) {
  if (report.work_offset) offset_ = report.work_offset;
  report_ = report;
  reported_ = now_;
}

void GrblSender::hear_setting(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return;
  const auto number = number_after(line.substr(0, equals), "$");
  const auto value = read_grbl_place(line.substr(equals + 1, line.find(' ', equals) - equals - 1));
  if (number && value) machine_.settings[*number] = value->values[0];
}

// [VER:1.1h.20190830:] and [OPT:V,15,128]; [G54:0.000,0.000,0.000] … [TLO:0.000]
void GrblSender::hear_bracket(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = line.substr(colon + 1);
  if (name == "VER") machine_.version = value.substr(0, value.find(':'));
  if (name == "OPT") hear_options(value);
  const bool is_offset = (name.size() == 3 && name.starts_with("G5")) || name == "G92" || name == "TLO";
  if (!is_offset) return;
  auto place = read_grbl_place(value);
  if (!place) return;
  if (name == "TLO" && value.find(',') == std::string_view::npos) {
    (*place)[Axis::z] = std::exchange((*place)[Axis::x], 0.0);
  }
  machine_.offsets[std::string(name)] = *place * unit();
}

void GrblSender::hear_options(std::string_view options) {
  const auto sizes = read_grbl_place(options.substr(std::min(options.find(','), options.size() - 1) + 1));
  if (!sizes) return;
  const double blocks = sizes->values[0];
  const double bytes = sizes->values[1];
  if (blocks >= 1 && blocks <= 10000) machine_.blocks = static_cast<std::size_t>(blocks);
  if (bytes >= 64 && bytes <= 65536) machine_.bytes = static_cast<std::size_t>(bytes);
}

void GrblSender::hear_banner() {
  switch (stage_) {
    case Stage::waking: stage_since_ = now_ - start_of_an_arduino; return;
    case Stage::clearing:
    case Stage::stopped: return;
    case Stage::dropping:
      unanswered_.clear();
      unanswered_bytes_ = 0;
      stage_ = Stage::stopped;
      return;
    case Stage::asking:
    case Stage::ready:
    case Stage::braking: break;
  }
  fail({.code = "grbl.restarted",
        .message =
            "the machine has started anew: its reset button, its power, or another program. It may have lost its "
            "place",
        .first_line = first_held_line(),
        .last_line = last_line_});
  waiting_.clear();
  unanswered_.clear();
  unanswered_bytes_ = 0;
  stage_ = Stage::stopped;
}

void GrblSender::answer(int error) {
  if (unanswered_.empty()) return;  // of what another sender has left
  const Line line = std::move(unanswered_.front());
  unanswered_.pop_front();
  unanswered_bytes_ -= line.text.size();
  answered_ = now_;
  if (error == 0) {
    if (line.line != 0) held_lines_.push_back(line.line);
    if (held_lines_.size() > machine_.blocks + 8) held_lines_.pop_front();
    return;
  }
  fail({.code = "grbl.error",
        .message = fmt::format("the machine refuses \"{}\": error:{}, {}", without_end(line.text), error,
                               words_of_grbl_error(error)),
        .first_line = line.line,
        .last_line = line.line});
  // What follows is in the machine already. It must not go on without the refused line.
  if (has_work_ && stage_ == Stage::ready) stop();
}

void GrblSender::alarm(int number) {
  fail({.code = "grbl.alarm",
        .message = fmt::format("ALARM:{}, {}", number, words_of_grbl_alarm(number)),
        .first_line = first_held_line(),
        .last_line = last_line_});
  waiting_.clear();
  stage_ = Stage::stopped;
}

}  // namespace passo
