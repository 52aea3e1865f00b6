// passo board files: lists, sends, runs and deletes the files on the card of a Grbl board.
#include "passo/sender/board_files.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "commands.hpp"
#include "grbl_connection.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/report/output_file.hpp"
#include "passo/sender/file_upload.hpp"

namespace passo {
namespace {

using nlohmann::ordered_json;

// A full card on a slow line.
constexpr Seconds longest_list{60};
constexpr Seconds longest_begin{10};
constexpr Seconds shortest_run{1};

int print_text(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_output();
}

// Asks for all files. False, with a message and `code`: there is no answer.
bool list_files(GrblConnection& opened, BoardFiles& files, std::vector<std::string>& missing, int& code) {
  for (const std::string& question : files.questions()) {
    const auto answer = opened.ask(question, longest_list, code);
    if (!answer) return false;
    if (!answer->error.empty()) missing.push_back(fmt::format("{}: {}", question, answer->error));
    files.hear(question, answer->said);
  }
  return true;
}

int list(const BoardFilesArguments& arguments, GrblConnection& opened, BoardFiles& files) {
  int code = exit_done;
  std::vector<std::string> missing;
  if (!list_files(opened, files, missing, code)) return code;
  if (missing.size() == files.questions().size()) {
    return fail(exit_failed, fmt::format("{}: the board cannot list its files ({}): is a card inserted? [board.files]",
                                         arguments.board, missing.front()));
  }
  ordered_json json = {{"files", ordered_json::array()}};
  std::string text;
  for (const StoredFile& file : files.all()) {
    json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"can_run", file.can_run}});
    text += fmt::format("{:>10}  {}{}\n", file.bytes, file.path, file.can_run ? "" : "  (its name cannot be used)");
  }
  if (files.all().empty()) text = "no files\n";
  for (const std::string& one : missing) {
    if (!arguments.json) note(fmt::format("{}: {}", arguments.board, one));
  }
  return print_text(arguments.json ? json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n" : text);
}

// Only a file of the list: FluidNC would also delete a folder with all that is in it.
int remove(const BoardFilesArguments& arguments, GrblConnection& opened, BoardFiles& files) {
  int code = exit_done;
  std::vector<std::string> missing;
  if (!list_files(opened, files, missing, code)) return code;
  const bool is_there = std::ranges::find(files.all(), arguments.remove, &StoredFile::path) != files.all().end();
  const auto line = files.remove_line(arguments.remove);
  if (!is_there || !line) {
    const std::string why = line ? "the board has no such file" : line.error();
    return fail(exit_bad_program, fmt::format("--delete {}: {} [board.files]", arguments.remove, why));
  }
  const auto answer = opened.ask(*line, longest_begin, code);
  if (!answer) return code;
  if (!answer->error.empty()) {
    return fail(exit_failed,
                fmt::format("{}: the board rejects {}: {} [board.files]", arguments.board, *line, answer->error));
  }
  const ordered_json json = {{"path", arguments.remove}};
  return print_text(arguments.json ? json.dump(2) + "\n" : arguments.remove + " deleted\n");
}

int upload(const BoardFilesArguments& arguments, GrblConnection& opened, const BoardFiles& files, std::string content) {
  const std::string name = std::filesystem::path(arguments.upload).filename().string();
  const std::string path = !arguments.as.empty() ? arguments.as : (files.is_fluidnc() ? "/sd/" : "/") + name;
  const std::size_t bytes = content.size();
  auto sent = FileUpload::begin(opened.sender().machine(), path, std::move(content));
  if (!sent) {
    return fail(exit_failed, fmt::format("{}: {}: {} [board.upload]", arguments.board, path, sent.error()));
  }
  int code = exit_done;
  if (!opened.upload(std::move(*sent), code)) return code;
  const ordered_json json = {{"path", path}, {"bytes", bytes}};
  return print_text(arguments.json ? json.dump(2) + "\n" : fmt::format("{}: {} sent\n", path, counted(bytes, "byte")));
}

// The board reads the file by itself, and reports how far it is. It ends in Idle.
int run_file(const BoardFilesArguments& arguments, GrblConnection& opened, const BoardFiles& files) {
  const auto line = files.run_line(arguments.run);
  if (!line) return fail(exit_bad_program, fmt::format("--run {}: {}", arguments.run, line.error()));
  GrblSender& sender = opened.sender();
  if (sender.report()->state == "Alarm") {
    return fail(exit_failed, arguments.board + ": the machine is locked by an alarm: home it first [grbl.locked]");
  }
  std::string rejected;
  sender.listen([&](std::string_view said) {
    if (said.starts_with("[MSG:ERR")) rejected = said;
  });
  int code = exit_done;
  const auto answer = opened.ask(*line, longest_begin, code);
  if (!answer) return code;
  if (!answer->error.empty()) {
    return fail(exit_failed,
                fmt::format("{}: the board rejects {}: {} [board.files]", arguments.board, *line, answer->error));
  }
  ProgressDisplay progress(arguments.run, !arguments.json);
  const Seconds begun = opened.now();
  Seconds active = begun;
  while (opened.now() - active < shortest_run || !sender.at_rest()) {
    if (interrupted_by() != 0) sender.stop();
    if (sender.stopped() || (sender.fault() && !sender.stops())) break;
    opened.poll(GrblConnection::between_looks);
    const auto& report = sender.report();
    if (report && (!report->rests() || report->file_share)) active = opened.now();
    if (report && report->file_share) progress.update(*report->file_share);
  }
  progress.clear();
  if (sender.stopped() || sender.fault()) return opened.give_up();
  if (!rejected.empty()) {
    return fail(exit_failed,
                fmt::format("{}: the board ended {}: {} [board.files]", arguments.board, arguments.run, rejected));
  }
  const double time = (active - begun).value();
  const ordered_json json = {{"path", arguments.run}, {"time_s", time}};
  return print_text(arguments.json ? json.dump(2) + "\n"
                                   : fmt::format("{}: {:.1f} s; stopped at {} (machine)\n", arguments.run, time,
                                                 place_words(opened.sender())));
}

}  // namespace

int board_files(const BoardFilesArguments& arguments) {
  if (!names_grbl_machine(arguments.board)) {
    return fail(exit_bad_program, arguments.board +
                                      ": only Grbl boards have such files: expected grbl:DEVICE[@BAUD], "
                                      "grbl:tcp:HOST:PORT or grbl:ws://HOST [board.not-grbl]");
  }
  std::string content;
  if (!arguments.upload.empty()) {
    Diagnostics diagnostics;
    auto read = read_bytes(
        arguments.upload, {.area = "board", .expected = "a file to send", .most = FileUpload::most_bytes}, diagnostics);
    show(diagnostics);
    if (!read) return exit_bad_program;
    content = std::move(*read);
  }
  int code = exit_done;
  brake_on_signals();
  const auto opened = GrblConnection::open(arguments.board, code);
  if (!opened) return code;
  auto files = BoardFiles::of(opened->sender().machine());
  if (!files) return fail(exit_failed, fmt::format("{}: {} [board.no-files]", arguments.board, files.error()));
  if (!arguments.upload.empty()) return upload(arguments, *opened, *files, std::move(content));
  if (!arguments.run.empty()) return run_file(arguments, *opened, *files);
  if (!arguments.remove.empty()) return remove(arguments, *opened, *files);
  return list(arguments, *opened, *files);
}

}  // namespace passo
