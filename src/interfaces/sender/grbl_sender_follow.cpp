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
  expected_.clear();
  marked_lines_.clear();
  mark_heard_ = false;
  unmarked_ = 0;
  sure_line_ = 0;
  marked_ = now_;
}

std::string GrblSender::send_lines(Seconds now) {
  std::string bytes;
  for (;;) {
    if (wants_mark() && window_.send_mark(std::string(mark), now, machine_.bytes)) {
      bytes += mark;
      expected_.push_back(follower_->modes());
      marked_lines_.push_back(window_.last_line());
      marked_ = now;
      unmarked_ = 0;
    }
    const UnacknowledgedLines::Line* const next = window_.next_fitting(machine_.bytes);
    if (next == nullptr || !follower_->may_send(next->text, now)) return bytes;
    follower_->sent(next->text, next->line, now);
    bytes += window_.send_next(now);
    ++unmarked_;
  }
}

bool GrblSender::wants_mark() const {
  if (unmarked_ == 0 || !has_work() || !follower_->knows_path()) return false;
  return unmarked_ >= lines_between_marks || now_ - marked_ >= between_marks || window_.waiting() == 0;
}

void GrblSender::fail_and_stop(std::string code, std::string message) {
  fail({.code = std::move(code),
        .message = std::move(message),
        .first_line = sure_line_,
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
  if (oldest == nullptr || !oldest->marks || mark_heard_) {
    if (oldest != nullptr && oldest->text == mark) return;  // asked by somebody else
    return fail_and_stop("grbl.lost-lines",
                         "the machine has answered fewer lines than it was sent: a line was lost or broken on the way");
  }
  mark_heard_ = true;
  if (auto trouble = follower_->check_modes(modes, expected_.front(), machine_.in_inches())) {
    fail_and_stop(std::move(*trouble));
  }
}

void GrblSender::answer_mark() {
  const bool heard = std::exchange(mark_heard_, false);
  if (!expected_.empty()) expected_.pop_front();
  if (!marked_lines_.empty()) {
    if (heard) sure_line_ = marked_lines_.front();
    marked_lines_.pop_front();
  }
  if (heard || stage_ != Stage::ready) return;
  fail_and_stop("grbl.lost-lines",
                "the answers of the machine do not fit the lines that it was sent: a line was doubled or broken on the "
                "way");
}

void GrblSender::follow_report(const GrblReport& report) {
  if (!follower_ || stage_ != Stage::ready || fault_) return;
  const auto at = place();
  if (!at) return;
  const bool ends = report.state == "Idle" && window_.all_answered() && reports_.came_after(answered_);
  if (auto trouble = follower_->hear(*at, report.rests() && report.state != "Idle", ends, now_)) {
    fail_and_stop(std::move(*trouble));
  }
}

}  // namespace passo
