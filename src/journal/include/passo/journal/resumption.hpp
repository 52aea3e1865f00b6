// Resumption: whether and from where a job goes on that another host has begun, by its journal and what the board says.
//
// Refused is what is not certain: a board that has forgotten its session, or may have lost steps; a rest that the
// journal does not know; counts of the board that are not those of the place. Each check stands for itself: the
// counts must fit even where the journal is sure.
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
  board_reset,    // it has started anew since
  other_session,  // another host has said hello to it since
  not_trusted,    // it has stopped its motors at once
  rest_unknown,   // the journal does not know where it rests
  path_changed,   // the program's path has no such place
  counts_differ,  // its motors stand elsewhere
  in_thread,      // what follows the spindle by place has no other beginning than its own
};
// For scripts; never changes.
std::string_view code_of(ResumeRefusal refusal);
// A sentence without a full stop.
std::string_view message_of(ResumeRefusal refusal);

// Why this board cannot be the one that the journal's job was last at, moving or not. Nothing: it is.
std::optional<ResumeRefusal> refuse_stranger(const Journal& journal, const BoardStatus& status);

// The board rests.
Result<ResumePoint, ResumeRefusal> resume_point_of(const Journal& journal, const BoardStatus& status,
                                                   const ProgramReader& program, const MachineDescription& machine,
                                                   const InterpreterOptions& options);
// Its motors are where the job of that journal has them at that point.
bool stands_at(const JournalHead& head, const ResumePoint& point, const BoardStatus& status);

// The head of a journal, before the board's new session: of a job that begins where the board rests, or of one that
// goes on from that point.
// `steps`: of each motor from machine zero, where the job begins.
JournalHead head_of_beginning(JournalHead job, const BoardStatus& status,
                              const std::array<std::int64_t, max_motors>& steps, std::size_t motors);
JournalHead head_of_resumption(JournalHead before, const BoardStatus& status, const ResumePoint& point);

}  // namespace passo
