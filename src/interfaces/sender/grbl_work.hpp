// The activity of a GrblMachineSession. Private to sender/.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "passo/activity/jog_line.hpp"
#include "passo/activity/probe_line.hpp"
#include "passo/activity/program.hpp"
#include "passo/activity/streamed_program.hpp"
#include "passo/sender/grbl_executed.hpp"
#include "passo/sender/grbl_feed.hpp"
#include "passo/sender/grbl_machine_session.hpp"

namespace passo {

struct GrblMachineSession::Work {
  enum class Stage : std::uint8_t {
    prepares,  // the board's modes are set, and its offsets are read
    moves,
    brakes,   // until the sender has stopped
    resyncs,  // the board is asked again who and where it is
    ended
  };

  struct Progress {
    GrblExecuted executed;
    std::deque<PathItem> unplayed;   // sent and not executed, for watchers.motion
    Seconds skipped{0};              // nominal time of what comes before the point where the program begins
    Seconds reached{0};              // nominal time from the beginning of the program
    std::uint64_t lines_before = 0;  // lines sent before this work
    std::uint64_t stops = 0;         // program stops that it has come to
    std::uint64_t outputs_line = 0;  // the sender's line with the last change of the outputs

    // `dwell_left`: of the present dwell. Between its end and the next report nothing of it is left either.
    void update(std::optional<Seconds> dwell_left) { reached = std::max(reached, skipped + executed.time(dwell_left)); }
  };
  // Where the machine stood, and its work zero, when it came to the stop at which the program waits.
  struct Stop {
    Point place;
    std::optional<Point> zero;
    bool is_moved = false;  // by others, since then
  };
  struct Hold {
    bool asked = false;  // by a request
    bool door = false;   // the same, as for an open door
    bool heard = false;  // the board has reported it
    bool told = false;   // that the machine has come to rest
    Seconds at{0};
    std::optional<Stop> stop = {};
    std::optional<Stop> line_wait = {};  // a stream has no further line yet
  };
  struct Jog {
    std::unique_ptr<JogLine> line;  // null: this is no jog
    Point from;
    MmPerSecond highest{0};  // speed, of which a share is used
    MmPerSecond2 acceleration{0};
    MmPerSecond speed{0};
    Mm length{0};
    Mm sent{0};   // end of the last piece
    Mm ahead{0};  // how far pieces are sent ahead of the reported position
    Seconds lease{0};
    Seconds lease_end{0};
    std::optional<Seconds> cancelled_at;
    bool freed = false;  // a cycle start has followed the last cancel

    // Pieces that are sent later have this speed. They are sent ahead by the way between two reports, and to brake.
    void set_share(double share) {
      constexpr double two_reports = 0.25;  // s
      speed = MmPerSecond(highest.value() * share);
      const double v = speed.value();
      ahead = Mm(v * two_reports + 0.6 * v * v / acceleration.value());
    }
  };

  struct Probing {
    StoredResults results;
    std::unique_ptr<ProbeLine> line;  // null: this is no probe move
  };
  // A file that the board runs by itself.
  struct BoardFile {
    std::string path;         // empty: this is none
    std::string line;         // that begins it
    bool is_running = false;  // the board has begun
    bool has_ended = false;
    double share = 0;           // that the board has read, 0 to 1
    Seconds active{0};          // when the board last showed that it runs
    std::uint64_t reports = 0;  // that had come by then
    std::string trouble = {};   // what the board says of an error in it
  };

  bool is_board_file() const { return !board_file.path.empty(); }
  // Whether this is a program, which can be held and resumed.
  bool is_program() const { return program != nullptr || lines != nullptr || is_board_file(); }
  std::string words_at(std::uint32_t line) {
    if (program != nullptr) return program->operator_messages().at(line);
    return lines != nullptr ? lines->operator_messages().at(line) : std::string();
  }

  ActivityKind kind = ActivityKind::program;
  Ticket ticket = 0;
  Stage stage = Stage::prepares;
  bool stopped = false;  // by a request
  bool drops = false;    // the queued lines are dropped
  std::optional<ActivityFault> fault = {};
  std::optional<Axis> homes = {};  // the only axis that is homed

  // A program, lines of a client, or a probe move: each is a path.
  std::optional<request::Start> start;
  Diagnostics own_findings;
  Diagnostics* findings = &own_findings;
  std::unique_ptr<GrblProgramPath> program;
  StreamedProgram* lines = nullptr;
  Probing probing;
  BoardFile board_file;
  Watchers watchers;
  std::unique_ptr<GrblFeed> feed;
  Progress progress;
  Hold hold;

  std::unique_ptr<ProgramChecker> checker;

  Jog jog;
};

}  // namespace passo
