// MdiLines: G-code lines entered in the web interface (MDI, manual data input). They form one endless program, so modes
// persist from line to line, as in LinuxCNC and grbl. grbl's $ commands are also accepted.
//
//   POST /mdi -> MdiLines -> StreamedProgram -> request::Stream to MachineSession
//
// A line is executed as a whole, or refused without any effect. The machine is idle again after a line, unless the
// lines have left the spindle or the coolant on: then the stream waits for the next line. When the stream ends for any
// reason, both are switched off.
//
// The modes are reset to those of a program's start after a job, M2, M30, an alarm, a reset, and after another client
// has been in control. A stop keeps them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/streamed_program.hpp"
#include "passo/api/program_store.hpp"
#include "passo/diagnostics/finding_words.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class MdiLines {
 public:
  static constexpr std::size_t longest_line = 255;

  // All references must outlive this object.
  MdiLines(const MachineDescription& machine, MachineSession& session, ProgramStore& programs);

  struct Answer {
    std::string code;  // empty: the line was accepted
    FindingWords message;
    FindingWords expected;           // what was expected instead; may be empty
    std::vector<std::string> words;  // the output requested by a $ command
  };
  Answer execute(std::string_view line);

  void on_change(const MachineChange& change);
  // Ends the stream if nothing is left to do. Returns true if the lines have changed offsets or tools, and the machine
  // is idle.
  bool poll();
  // Resets the modes to those of a program's start.
  void begin_anew();
  // Applies changed work offsets. The modes stay.
  void apply_offsets();

  // Returns whether lines are running, or have left an output on.
  bool streams() const { return ticket_.has_value(); }
  ActiveModes modes() const;
  // Returns why the last line was not completed, e.g. a probe without contact. Empty: it was.
  const FindingWords& trouble() const { return trouble_; }
  // Increases with each change of the state returned here.
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
  std::shared_ptr<StreamedProgram> program_;
  std::shared_ptr<StreamedProgram> streamed_;  // the session may still use it
  std::optional<Ticket> ticket_;               // the session's ticket of the stream
  bool stops_ = false;                         // the end of the stream was requested
  bool ended_ = false;                         // the program was ended by M2 or M30
  bool changed_ = false;                       // a line was accepted, and its effect has not been queried yet
  std::optional<ProbeOutcome> probe_;
  FindingWords trouble_;
  std::uint64_t version_ = 0;
};

}  // namespace passo
