// How GrblSender follows the machine: what it sends in which order, and what it compares.
#include <string>
#include <utility>

#include "passo/sender/grbl_forecast.hpp"
#include "passo/sender/grbl_sender.hpp"

namespace passo {
namespace {

// A mark follows so many lines, or this time.
constexpr std::size_t lines_between_marks = 24;
constexpr Seconds between_marks{0.5};
constexpr std::string_view mark = "$G\n";

}  // namespace

void GrblSender::follow(const Point& zero, Seconds ahead) {
  follower_.reset();
  const auto start = place();
  const GrblLimits limits = limits_of(machine_);
  if (!start || limits.steps_per_mm == PerAxis<double>()) return;
  follower_.emplace(limits, *start, zero, ahead);
  follower_->set_override(override_.feed);
  marks_.marked.clear();
  marks_.modes.reset();
  marks_.since = 0;
  marks_.sure_line = 0;
  marks_.sent = now_;
}

std::string GrblSender::send_lines(Seconds now) {
  std::string bytes;
  for (;;) {
    if (wants_mark() && window_.send_mark(std::string(mark), now, machine_.bytes)) {
      bytes += mark;
      marks_.marked.push_back({.modes = follower_->modes(), .line = window_.last_line()});
      marks_.sent = now;
      marks_.since = 0;
    }
    const UnacknowledgedLines::Line* const next = window_.next_fitting(machine_.bytes);
    if (next == nullptr || !follower_->may_send(next->text, now)) return bytes;
    follower_->sent(next->text, next->line, now);
    bytes += window_.send_next(now);
    ++marks_.since;
  }
}

bool GrblSender::wants_mark() const {
  if (marks_.since == 0 || !has_work() || !follower_->knows_path()) return false;
  return marks_.since >= lines_between_marks || now_ - marks_.sent >= between_marks || window_.waiting() == 0;
}

void GrblSender::fail_and_stop(std::string code, std::string message) {
  fail({.code = std::move(code),
        .message = std::move(message),
        .first_line = marks_.sure_line,
        .last_line = window_.last_line()});
  stop();
}

void GrblSender::fail_and_stop(GrblFollower::Trouble trouble) {
  fail({.code = std::move(trouble.code),
        .message = std::move(trouble.message),
        .first_line = trouble.first_line,
        .last_line = trouble.last_line});
  stop();
}

void GrblSender::hear_modes(std::string_view modes) {
  if (stage_ != Stage::ready || !has_work()) return;
  const UnacknowledgedLines::Line* const oldest = window_.oldest();
  if (oldest != nullptr && oldest->marks) {
    marks_.modes = modes;  // the last ones before the answer are those of the mark
    return;
  }
  const bool is_asked_by_others = oldest != nullptr && oldest->text == mark;
  if (is_asked_by_others || machine_.tells_modes_unasked()) return;
  fail_and_stop("grbl.lost-lines",
                "the machine has answered fewer lines than it was sent: a line was lost or corrupted on the way");
}

void GrblSender::answer_mark() {
  const std::optional<std::string> modes = std::exchange(marks_.modes, {});
  if (marks_.marked.empty()) return;
  const Marks::Mark marked = std::move(marks_.marked.front());
  marks_.marked.pop_front();
  if (!follower_ || stage_ != Stage::ready) return;
  if (modes) {
    auto trouble = follower_->check_modes(*modes, marked.modes, machine_.in_inches());
    if (trouble) return fail_and_stop(std::move(*trouble));
    marks_.sure_line = marked.line;
    return;
  }
  fail_and_stop("grbl.lost-lines",
                "the answers of the machine do not fit the lines that it was sent: a line was doubled or broken on the "
                "way");
}

void GrblSender::follow_report(const GrblReport& report) {
  if (!follower_ || stage_ != Stage::ready || fault_) return;
  const auto at = place();
  if (!at) return;
  const bool ends = report.state == "Idle" && window_.all_answered() && reports_.came_after(last_.answered);
  if (auto trouble = follower_->hear(*at, report.rests() && report.state != "Idle", ends, now_)) {
    fail_and_stop(std::move(*trouble));
  }
}

}  // namespace passo
