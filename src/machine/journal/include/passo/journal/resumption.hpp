// Resumption: decides whether, and from where, a host continues a job that another host has begun. The decision uses
// the journal and the board's status.
//
// Every uncertain case is rejected: a board that has forgotten its session or may have lost steps, a stop point that is
// not in the journal, or board counts that do not match the position. Each check is independent: the counts must match
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
  board_reset,    // the board was restarted
  other_session,  // another host has connected to the board since
  session_ended,  // the machine was moved with the board's keypad, or a host has only sent a hello
  not_trusted,    // the board has stopped its motors instantly
  drivers_off,    // the board has switched the drivers off
  rest_unknown,   // the journal does not contain the board's stop point
  path_changed,   // the program's path does not contain that position
  counts_differ,  // the motors are at a different position
  in_thread,      // a thread can be entered only at its beginning
};
// A stable code for scripts.
std::string_view code_of(ResumeRefusal refusal);
// A sentence without a full stop.
std::string_view message_of(ResumeRefusal refusal);

// Why this board, stopped or moving, is not the one that last executed the journal's job. Empty: it is.
std::optional<ResumeRefusal> refuse_stranger(const Journal& journal, const BoardStatus& status);
// Why the job cannot continue from the board's position, as far as this is known without the program. Empty: it can.
std::optional<ResumeRefusal> refuse_rest(const Journal& journal, const BoardStatus& status);

// Finds the point at which the job continues. The status must be that of a stopped board.
Result<ResumePoint, ResumeRefusal> resume_point_of(const Journal& journal, const BoardStatus& status,
                                                   const ProgramReader& program, const MachineDescription& machine,
                                                   const InterpreterOptions& options);
// Returns true if the board's counts agree with the job at that point, or, before an unknown probe move, with a
// position on that move.
bool stands_at(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
               const MachineDescription& machine);
// Returns the machine position, at that point or on an unknown probe move.
Point place_by_counts(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                      const MachineDescription& machine);

// The head of a journal, before the board's new session. head_of_beginning() is for a job that starts at the board's
// position, head_of_resumption() for a job that continues from `point`. `steps`: steps of each motor from machine zero
// at the start of the job.
JournalHead head_of_beginning(JournalHead job, const BoardStatus& status,
                              const std::array<std::int64_t, max_motors>& steps, std::size_t motors);
JournalHead head_of_resumption(JournalHead before, const BoardStatus& status, const ResumePoint& point);

}  // namespace passo
