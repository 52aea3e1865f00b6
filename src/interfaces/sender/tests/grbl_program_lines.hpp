// A program as the lines for a Grbl machine, without a session.
#pragma once

#include "passo/sender/grbl_feed.hpp"

namespace passo::test {

struct GrblProgramLines {
  GrblProgramLines(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
                   const GrblTarget& target, bool waits)
      : path(program.again(), machine, options, unheard, {}), feed(path, path.answers(), target, waits, waits) {}

  std::optional<GrblFeed::Line> next() { return feed.next(); }
  bool ended() const { return feed.asks() == GrblFeed::Asks::end; }

  Diagnostics unheard;
  GrblProgramPath path;
  GrblFeed feed;
};

}  // namespace passo::test
