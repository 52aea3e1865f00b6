// Resumption: decides whether, and from where, a host goes on with a job that another host has begun. The journal and
// the board's status decide.
//
// Whatever is not certain is refused: a board that has forgotten its session or may have lost steps, a rest that the
// journal does not know, or board counts that do not match the place. Each check is independent: the counts must match
// even if the journal is certain.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/journal/journal.hpp"
#include "passo/journal/resume_point.hpp"

namespace passo {

enum class ResumeRefusal : std::uint8_t {
  board_reset,    // the board has restarted since
  other_session,  // another host has connected to the board since
  session_ended,  // the machine was moved with the board's keypad, or a host has only sent a hello
  not_trusted,    // the board has stopped its motors at once
  drivers_off,    // the board has switched the drivers off
  rest_unknown,   // the journal does not contain the board's stop point
  path_changed,   // the program's path has no such place
  counts_differ,  // the motors stand elsewhere
  in_thread,      // a thread can begin only at its own beginning
};
// A code for scripts. A code never changes.
std::string_view code_of(ResumeRefusal refusal);
// A sentence without a full stop.
std::string_view message_of(ResumeRefusal refusal);

// Why this board, moving or not, cannot be the one that last worked on the journal's job. Empty: the board is that one.
std::optional<ResumeRefusal> refuse_stranger(const Journal& journal, const BoardStatus& status);
// Why the job cannot continue from the board's position, as far as this is known without the program. Empty: it can.
std::optional<ResumeRefusal> refuse_rest(const Journal& journal, const BoardStatus& status);

// The point at which the job continues. The status must be one of a board at rest.
Result<ResumePoint, ResumeRefusal> resume_point_of(const Journal& journal, const BoardStatus& status,
                                                   const ProgramReader& program, const MachineDescription& machine,
                                                   const InterpreterOptions& options);
// True: the board's counts agree with the job at that point, or, before an unknown probe move, with a position on that
// move.
bool stands_at(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
               const MachineDescription& machine);
// The machine position, at that point or on an unknown probe move.
Point place_by_counts(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                      const MachineDescription& machine);

// The head of a journal, before the board's new session. head_of_beginning() is for a job that starts at the board's
// position, head_of_resumption() for a job that continues from `point`. `steps`: steps of each motor from machine zero
// where the job begins.
JournalHead head_of_beginning(JournalHead job, const BoardStatus& status,
                              const std::array<std::int64_t, max_motors>& steps, std::size_t motors);
JournalHead head_of_resumption(JournalHead before, const BoardStatus& status, const ResumePoint& point);

}  // namespace passo
