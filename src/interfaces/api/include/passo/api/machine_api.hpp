// MachineApi: a machine for programs and browsers, by HTTP and WebSocket. It turns JSON into requests of the machine's
// session, and the session's status into JSON.
//
//   WebServer -> MachineApi -> requests to MachineSession
//             <- JSON       <- status and changes
//
// Place on the street: beside the street, above the session, as GrblController is for senders. It knows no sockets and
// no clock. docs/api/openapi.json describes each request; lengths are mm, speeds mm/min, times seconds.
//
// Invariants: only the owner of motion moves the machine; everybody may hold and stop. A program runs only after a good
// check from the place where the machine stands. Memory is bounded.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/homing_repeats.hpp"
#include "passo/api/api_routes.hpp"
#include "passo/api/kept_job.hpp"
#include "passo/api/maker.hpp"
#include "passo/api/mdi_lines.hpp"
#include "passo/api/motion_owner.hpp"
#include "passo/api/motion_times.hpp"
#include "passo/api/program_store.hpp"
#include "passo/api/program_uploads.hpp"
#include "passo/api/studies.hpp"
#include "passo/history/job_history.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

enum class JobState : std::uint8_t { none, checking, running, done, stopped, failed, interrupted };
std::string_view name_of(JobState state);

// A program that was asked to run, and what has become of it.
struct ApiJob {
  std::uint64_t id = 0;
  std::uint64_t program = 0;
  std::string name;
  JobState state = JobState::none;
  std::string why;           // of one that failed, a sentence without a full stop
  std::int64_t history = 0;  // its number in the history; 0: nobody keeps one
  friend bool operator==(const ApiJob&, const ApiJob&) = default;
};

// The machine file on the disk.
struct MachineFileAccess {
  std::string name;  // for people
  std::function<std::optional<std::string>()> read = {};
  // Writes `after`, if the file is still as `before`. Returns why it could not; empty: it is written. Null: the machine
  // is no file.
  std::function<std::string(const std::string& before, const std::string& after)> write = {};
};

struct ApiOptions {
  std::string version;                    // of the program
  std::string openapi;                    // the text of docs/api/openapi.json
  std::function<std::string()> make_key;  // a text that nobody guesses, for an owner of motion
  // What serves other paths: a folder with a page. Empty: nothing does.
  std::function<std::optional<WebAnswer>(const WebRequest& request)> page = {};
  // Keeps the queue of jobs and what became of them; outlives this. Null: there is no queue, and nothing is kept.
  JobHistory* history = nullptr;
  std::function<double()> wall_time = {};  // seconds since 1970, for the history
  // Keeps the journal of a job, with a history; outlives this. Null: a job that is broken off cannot go on.
  JobKeeper* keeper = nullptr;
  FileStamp machine_file = {};            // as it was read
  MachineFileAccess machine_access = {};  // for an editor
  // The offsets and tools of the programs at the beginning, and what keeps them when they have changed: it returns why
  // it could not, or an empty text.
  SavedParameters parameters = {};
  ToolTable tools = {};
  std::function<std::string(const SavedParameters&, const ToolTable&)> keep_offsets = {};
  std::optional<BrokenOff> broken_off = {};  // the job of an earlier program
  // Makes programs of drawings; outlives this. Null: nobody does.
  Maker* maker = nullptr;
  // Works out what takes longer; outlives this. Null: nobody does.
  Studies* studies = nullptr;
  // Times the motion of programs; outlives this. Null: nobody does, and the time left is not known.
  MotionTimer* timer = nullptr;
};

// What a job has said by (PRINT,…), (MSG,…) and (LOG,…).
struct JobWords {
  std::string_view kind;  // "print", "message" or "log"
  std::uint32_t line = 0;
  std::string text;
};

class MachineApi final : public WebHandler {
 public:
  // More is not kept of one job.
  static constexpr std::size_t most_words = 50'000;
  static constexpr std::size_t longest_words = 200;
  // The longest program that is levelled: a machine that rests waits for that.
  static constexpr std::size_t longest_to_level = std::size_t{16} << 20;

  // All of them outlive this.
  MachineApi(const MachineDescription& machine, MachineSession& session, MotionOwner& owner, ApiOptions options);

  WebAnswer answer(const WebRequest& request) override;
  WebAnswer refusal(unsigned status) override;
  std::size_t longest_body(const WebRequest& request) override;
  // The page itself is no secret: what it asks of the API needs the token.
  bool is_public(const WebRequest& request) override {
    return options_.page && request.method == "GET" && !request.path.starts_with("/api/");
  }
  bool is_stream(std::string_view path) override { return path == "/api/v1/stream"; }
  // {"do": "/api/v1/jog/renew", "key": "…", "body": {…}} is a POST; the answer has "do", "status" and "body".
  std::string hear(std::string_view message, std::uint64_t client) override;
  void gone(std::uint64_t client) override;

  // Heeds what has happened. `changes`: the session's, since the last call. Call after each turn of the session.
  void heed(const std::vector<MachineChange>& changes);
  // Does a bounded piece of what was asked: about a millisecond of a check, or the disk's time while the machine rests.
  // Call once in each round of the loop.
  void turn();
  // True: turn() has more to do at once.
  bool is_checking() const { return programs_.checks(); }
  // The status, as GET /api/v1/status gives it.
  std::string status_text() const;
  // The offsets and tools of the programs. take_offsets() takes those that a sender has changed.
  const SavedParameters& parameters() const { return programs_.parameters(); }
  const ToolTable& tools() const { return programs_.tools(); }
  void take_offsets(const SavedParameters& parameters);
  // A sender's offsets could not be kept, for this reason. Empty: they are.
  void note_unkept_offsets(std::string why) { offsets_trouble_ = std::move(why); }
  // Where the motors of the job that was broken off were last, as far as that is sure. Empty: there is none.
  std::optional<Point> broken_off_at();
  // What web servers count, for the metrics.
  void watch(const WebServer& server) { server_ = &server; }
  const ApiJob& job() const { return job_; }
  // Of the job that runs, as far as it is known.
  std::optional<Seconds> time_left() const { return time_left(session_.status()); }
  // Grows when the modes of the lines that a person types have changed.
  std::uint64_t mdi_version() const { return mdi_.version(); }
  // From now on a job that is stopped was broken off: the program is about to end.
  void leave();

  // A client that owns the motion, and was not heard for so long while nothing moved, owns it no longer.
  static constexpr Seconds silent_owner{300};
  // One whose streams have all ended may come back so long.
  static constexpr Seconds owner_returns_within{5};

 private:
  WebAnswer look(const FoundRoute& found, const WebRequest& request);
  WebAnswer change(const FoundRoute& found, const WebRequest& request);
  WebAnswer change_programs(const FoundRoute& found, const WebRequest& request);
  WebAnswer choose_lines(const StoredProgram& program, std::string_view text);
  WebAnswer look_at_uploads(const FoundRoute& found) const;
  WebAnswer begin_upload(const WebRequest& request);
  WebAnswer change_uploads(const FoundRoute& found, const WebRequest& request);
  WebAnswer look_at_history(const FoundRoute& found, const WebRequest& request);
  WebAnswer change_queue(const FoundRoute& found, const WebRequest& request);
  WebAnswer take_ownership(const WebRequest& request);
  WebAnswer change_owner(const FoundRoute& found, const WebRequest& request);
  bool is_owner_gone() const;
  void mind_owner();
  WebAnswer ask(Request wanted);
  WebAnswer ticket_answer(Ticket ticket) const;
  WebAnswer set_work_zero(std::string_view body);
  WebAnswer take_mdi(std::string_view body);
  void mind_mdi();
  WebAnswer begin_probing(std::string_view body);
  WebAnswer take_height_map(const StoredProgram& program, const WebRequest& request);
  WebAnswer level_program(const StoredProgram& program, std::string_view query);
  WebAnswer words_answer() const;
  void note_words(const Operation& operation);
  void heed_state(MachineState state);
  void note_wait();
  bool is_free_to_move(const MachineStatus& status) const;
  void step_aside();
  Result<Reentry, ReentryProblem> way_behind_stop() const;
  WebAnswer go_on_behind_stop();
  WebAnswer stop_parked_job();
  WebAnswer parked_refusal() const;
  void keep_results();
  void keep_offsets();
  void keep_all();
  std::string unkept() const;
  WebAnswer no_room_in_history() const;
  void keep_results(const SavedParameters& parameters, const ToolTable& tools);
  WebAnswer change_machine_file(const FoundRoute& found, const WebRequest& request);
  WebAnswer change_interrupted(const FoundRoute& found);
  WebAnswer change_making(const FoundRoute& found, const WebRequest& request);
  WebAnswer make_answer();
  WebAnswer made_picture(std::string_view query) const;
  WebAnswer made_page() const;
  WebAnswer pulses_answer(std::string_view query);
  WebAnswer keep_make_file(std::string_view name, std::string_view bytes);
  WebAnswer clear_make_files();
  WebAnswer begin_making(std::string_view body);
  void heed_maker();
  WebAnswer study_answer();
  WebAnswer study_file(bool picture) const;
  WebAnswer begin_study(std::string_view body);
  WebAnswer begin_job(const StoredProgram& program, std::int64_t history);
  WebAnswer resume_job(bool by_a_way_back);
  void note_alarm();
  double wall_time() const { return options_.wall_time ? options_.wall_time() : 0; }
  WebAnswer run_program(const StoredProgram& program, std::string_view query);
  Result<Reentry, ReentryProblem> way_to(const StoredProgram& program, const LinePlace& from) const;
  void begin_checked_job();
  void name_job();
  void start_job();
  void end_job(JobState state, std::string why = {});
  std::string metrics() const;
  bool may_pass_on() const;
  bool runs(const StoredProgram& program) const;
  void mind_times();
  std::optional<Seconds> time_left(const MachineStatus& status) const;

  const MachineDescription& machine_;
  MachineSession& session_;
  MotionOwner& owner_;
  ApiOptions options_;
  ProgramStore programs_;
  ProgramUploads uploads_;
  ApiJob job_;
  Seconds owner_heard_{0};
  std::set<std::uint64_t> owner_streams_;  // clients of the stream that have shown the owner's key
  std::optional<Seconds> stream_lost_;     // when the last of them went; empty: none has gone
  std::uint64_t job_owner_ = 0;            // MotionOwner::changes() when the job was asked for
  std::unique_ptr<KeptJob> kept_;          // null: no journal is kept
  bool resumes_ = false;                   // the job was broken off, and goes on
  bool reenters_ = false;                  // by a way back onto its path
  bool named_ = false;                     // the job's journal is begun
  std::optional<LinePlace> from_;          // where the job is to begin; empty: at its beginning
  std::optional<Reentry> way_;             // the way there
  std::string stopped_by_;                 // who has asked to stop the job
  bool leaves_ = false;
  std::string offsets_trouble_;      // why the offsets are not kept; empty: they are
  Seconds keeps_again_{0};           // what could not be written is tried again then
  std::string making_;               // what is made of what, as "board/a.gbr"; empty: no order runs
  std::vector<std::uint64_t> made_;  // the programs of the last order
  std::map<std::string, std::vector<std::uint64_t>, std::less<>> made_of_;
  std::string study_;          // the last one that was ordered
  std::uint64_t studied_ = 0;  // its program; 0: none
  std::optional<Ticket> ticket_;
  // A job that waits for a person, whose motion has ended so that the person may move the machine.
  struct ParkedJob {
    ApiJob job;
    OperatorWait wait;
    SavedParameters parameters;  // of then
    ToolTable tools;
    Point start;                       // where its path begins
    std::vector<ProbeOutcome> probes;  // what it has probed
  };
  std::optional<ParkedJob> parked_;
  bool goes_on_ = false;              // the parked job is about to begin behind its stop
  Point job_start_;                   // where the path of the job begins
  std::vector<ProbeOutcome> probes_;  // what the job has probed
  std::uint64_t last_job_ = 0;
  bool wait_noted_ = false;  // where the job waits for a person now
  Diagnostics findings_;     // of the run
  std::vector<JobWords> words_;
  // The program that is timed or was timed last, and its times, as far as they are known.
  std::uint64_t timed_ = 0;
  std::uint64_t timed_path_ = 0;
  MotionFactors timed_factors_;  // of the order
  bool is_timing_ = false;
  std::optional<MotionTimes> times_;  // of that program
  MotionFactors times_factors_;       // those that they were planned with
  std::uint64_t map_for_ = 0;         // the program that gets the height map which the job probes; 0: it probes none
  HomingRepeats repeats_;
  std::vector<HomedAxis> homed_;     // by the last homing
  std::optional<Point> homes_from_;  // where the machine stood, if that was known when a homing began
  bool homes_ = false;               // a homing goes on
  MdiLines mdi_;
  std::uint64_t mdi_owner_ = 0;  // MotionOwner::changes()
  const WebServer* server_ = nullptr;
  std::uint64_t jobs_ended_ = 0;
  std::uint64_t alarms_ = 0;
  std::uint64_t late_ = 0;  // rests because a refill came too late
};

}  // namespace passo
