// How long GrblSender waits for a machine that is silent, idle or stands still, and what it says then.
#include <algorithm>

#include <fmt/format.h>

#include "passo/sender/grbl_sender.hpp"

namespace passo {
namespace {

// A machine that is followed has answered each question so far.
constexpr Seconds longest_silence_in_motion{1.8};
// A machine that is idle for so long, with lines that it has not answered, has not got them.
constexpr Seconds longest_idle{2};

}  // namespace

void GrblSender::check_silence() {
  const Seconds since = std::max(last_.heard, last_.stage);
  const Seconds most = follower_ && has_work() && stage_ == Stage::ready ? longest_silence_in_motion : longest_silence;
  if (now_ - since < most + silence_of_oldest()) return;
  const char* const hint =
      greets() ? ": it is off, uses another baud rate (@BAUD), or is in an alarm that only a reset clears" : "";
  end_with(fault_between_lines(
      "grbl.no-answer", fmt::format("the machine has not answered for {:.0f} s{}", (now_ - since).value(), hint)));
}

// Bytes that a bad line has swallowed are never answered, and neither is a line by a machine that needs a reset.
void GrblSender::check_lost_bytes() {
  const bool is_locked = report()->state == "Alarm";
  const UnacknowledgedLines::Line* const oldest = window_.oldest();
  const bool waits = oldest != nullptr || (is_locked && has_work());
  if ((report()->state != "Idle" && !is_locked) || !waits) {
    last_.idle = now_;
    return;
  }
  Seconds since = std::max({last_.idle, last_.told, last_.answered});
  if (oldest != nullptr) since = std::max(since, oldest->sent);
  // By its reports, not by the clock: a machine that is silent is not idle.
  if (reports_.came() - since < longest_idle + silence_of_oldest()) return;
  if (is_locked && greets()) {
    return end_with(
        {.code = "grbl.locked",
         .message =
             "the machine is in an alarm and does not answer: reset it with its button, or switch its power off and on",
         .first_line = 0,
         .last_line = 0});
  }
  if (is_locked) return end_with(fault_between_lines("grbl.alarm", "the machine is locked by an alarm"));
  if (greets()) return end_with(fault_of_greeting());
  fail({.code = "grbl.lost-bytes",
        .message = fmt::format("the machine is idle, but has not answered \"{}\": bytes were lost on the serial link",
                               UnacknowledgedLines::without_end(oldest->text)),
        .first_line = oldest->line,
        .last_line = oldest->line});
  stop();
}

// Whether each report must show another position.
bool GrblSender::must_move() const {
  return follower_ && follower_->knows_path() && has_work() && report()->state == "Run";
}

// Whatever its state is: a machine that has something to do moves or answers.
void GrblSender::check_standstill() {
  const bool has_nothing_to_do =
      window_.oldest() == nullptr && (report()->state == "Idle" || report()->state == "Alarm");
  // A file of its own may dwell for long.
  const bool runs_file = report()->file_share.has_value();
  if (has_nothing_to_do || runs_file || !words_of_grbl_wait(*report()).empty()) last_.progress = now_;
  // A stall is judged by the reports, not by the clock: a machine that is silent may move.
  const Seconds stands = must_move() ? reports_.came() - last_.progress : now_ - last_.progress;
  const Seconds most = must_move() ? longest_stall + follower_->longest_between_changes() : longest_standstill;
  if (stands < most + silence_of_oldest()) return;
  fail(fault_between_lines("grbl.no-answer",
                           fmt::format("the machine is in state {}, but has neither moved nor answered for {:.0f} s",
                                       report()->state, stands.value())));
  stop();
}

GrblFault GrblSender::fault_of_greeting() const {
  constexpr std::size_t most_shown = 60;
  std::string words = "the machine does not report its state";
  if (report()) words = "the machine does not identify itself";
  if (report() && window_.oldest() != nullptr)
    words += fmt::format(" (to \"{}\")", UnacknowledgedLines::without_end(window_.oldest()->text));
  const std::string& heard = last_line_heard_.empty() ? came_ : last_line_heard_;
  const bool is_readable = std::ranges::all_of(heard, [](char letter) { return letter >= ' ' && letter <= '~'; });
  if (!is_readable) {
    words += ", and its answer is unreadable: it may use another baud rate (@BAUD)";
  } else if (!heard.empty()) {
    words += fmt::format(" as Grbl 1.1 does. It sent \"{}\"", heard.substr(0, most_shown));
  } else {
    words += " as Grbl 1.1 does";
  }
  return {.code = "grbl.no-answer", .message = std::move(words), .first_line = 0, .last_line = 0};
}

}  // namespace passo
