// MdiLines: lines that a person types at a page (MDI, manual data input). They are one program that never ends, so
// modes last from line to line, as in LinuxCNC and grbl; and the words of grbl that begin with $.
//
//   POST /mdi -> MdiLines -> OpenProgram -> request::Stream to MachineSession
//
// A line is taken as a whole, or refused and changes nothing. The machine is idle again when a line is done, unless the
// lines have left the spindle or the coolant on: then it waits for the next one. Whatever ends that switches both off.
//
// The modes are those of a program's start after a job, M2, M30, an alarm, a reset, and after somebody else has driven.
// A stop keeps them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/open_program.hpp"
#include "passo/api/program_store.hpp"
#include "passo/diagnostics/finding_words.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class MdiLines {
 public:
  static constexpr std::size_t longest_line = 255;

  // All of them outlive this.
  MdiLines(const MachineDescription& machine, MachineSession& session, ProgramStore& programs);

  struct Answer {
    std::string code;  // empty: the line was taken
    FindingWords message;
    FindingWords expected;           // what would have been right; may be empty
    std::vector<std::string> words;  // what a line with $ asks for
  };
  Answer execute(std::string_view line);

  void on_change(const MachineChange& change);
  // Ends the stream where nothing is left to do. True: the lines have changed offsets or tools, and the machine rests.
  bool poll();
  // The modes of a program's start.
  void begin_anew();
  // The work's zeros are others now. The modes stay.
  void apply_offsets();

  // The lines run, or have left something on.
  bool streams() const { return ticket_.has_value(); }
  ModesInForce modes() const;
  // Why the last line did not come to its end: a probe that touched nothing. Empty: it did.
  const FindingWords& trouble() const { return trouble_; }
  // Grows with each change of what is told here.
  std::uint64_t version() const { return version_; }
  SavedParameters parameters() const { return program_->parameters(); }
  const ToolTable& tools() const { return program_->tools(); }

 private:
  Answer execute_code(std::string_view line);
  Answer execute_command(const std::string& text);
  Answer ask(Request wanted);
  void make_program();

  const MachineDescription& machine_;
  MachineSession& session_;
  ProgramStore& programs_;
  std::shared_ptr<OpenProgram> program_;
  std::shared_ptr<OpenProgram> streamed_;  // the session may still look at it
  std::optional<Ticket> ticket_;           // of the stream
  bool stops_ = false;                     // the stream was asked to end
  bool ended_ = false;                     // by M2 or M30
  bool changed_ = false;                   // a line was taken, and nobody has asked what it has changed
  std::optional<ProbeOutcome> probe_;
  FindingWords trouble_;
  std::uint64_t version_ = 0;
};

}  // namespace passo
