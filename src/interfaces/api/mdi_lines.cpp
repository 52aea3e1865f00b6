#include "passo/api/mdi_lines.hpp"

#include <algorithm>
#include <utility>

#include "api_answers.hpp"
#include <fmt/format.h>

#include "passo/grbl/grbl_reports.hpp"
#include "passo/grbl/grbl_settings.hpp"
#include "passo/session/confirmed_place.hpp"

namespace passo {
namespace {

constexpr const char* help = "[HLP:$$ $# $G $I $H $X $SLP]";

bool is_off(const OutputState& outputs) {
  return outputs.spindle == SpindleDirection::off && !outputs.mist && !outputs.flood;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  return text.substr(first, last == std::string_view::npos ? 0 : last + 1 - first);
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find("\r\n"), text.size());
    if (end > 0) lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return lines;
}

MdiLines::Answer refused(std::string_view code, Sentence sentence) {
  return {.code = std::string(code), .message = std::move(sentence), .expected = {}, .words = {}};
}

MdiLines::Answer refused(const Refusal& refusal) {
  return refused(code_of(refusal.code()), refusal.sentence());
}

MdiLines::Answer told(std::string_view text) {
  return {.code = {}, .message = {}, .expected = {}, .words = lines_of(text)};
}

}  // namespace

MdiLines::MdiLines(const MachineDescription& machine, MachineSession& session, ProgramStore& programs)
    : machine_(machine), session_(session), programs_(programs) {
  make_program();
}

void MdiLines::make_program() {
  program_ = std::make_shared<StreamedProgram>(machine_, programs_.options_of(Dialect::linuxcnc),
                                               session_.status().position.place);
  ++version_;
}

void MdiLines::begin_anew() {
  ended_ = false;
  if (streams()) {
    ended_ = true;  // once the stream has ended
  } else {
    make_program();
  }
}

void MdiLines::apply_offsets() {
  program_->apply_offsets(programs_.parameters(), session_.status().position.place);
  ++version_;
}

ActiveModes MdiLines::modes() const {
  ActiveModes modes = program_->modes();
  if (!streams()) {
    modes.spindle = SpindleDirection::off;
    modes.mist = modes.flood = false;
  }
  return modes;
}

MdiLines::Answer MdiLines::execute(std::string_view line) {
  const std::string_view text = without_blanks(line);
  if (text.size() > longest_line) {
    return refused("mdi.too-long", {.code = "mdi.too-long",
                                    .arguments = {{"count", std::to_string(longest_line)}},
                                    .text = fmt::format("the line is longer than {} characters", longest_line)});
  }
  if (text.empty()) return {};
  if (text.front() != '$') return execute_code(text);
  std::string command;
  for (const char c : text) {
    if (c != ' ') command += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  }
  return execute_command(command);
}

MdiLines::Answer MdiLines::execute_code(std::string_view line) {
  const MachineState state = session_.state();
  if (!streams() && state != MachineState::idle) return refused("machine.busy", sentence_of_busy(state));
  if (streams() && (stops_ || !program_->room())) {
    return refused("machine.busy",
                   {.code = "machine.busy.earlier-lines", .text = "earlier lines are still running: wait"});
  }
  if (const auto closed = session_.closed_limit()) return refused(*closed);
  if (const auto lost = session_.lost_place()) return refused(*lost);
  if (!streams()) program_->drop(session_.status().position.place);
  if (machine_.tool_change != nullptr) program_->allow_tool_changes(is_place_confirmed(session_));
  if (auto wrong = program_->add_line(line, session_.now())) {
    return {.code = std::move(wrong->code),
            .message = std::move(wrong->message),
            .expected = std::move(wrong->expected),
            .words = {}};
  }
  trouble_ = {};
  changed_ = true;
  ++version_;
  ended_ = program_->take_ended() || ended_;
  if (!streams() && (program_->queued() > 0 || program_->asks())) {
    auto answer = ask(request::Stream{.program = program_.get()});
    if (!answer.code.empty()) program_->drop(session_.status().position.place);
    if (answer.code.empty()) streamed_ = program_;
    return answer;
  }
  return {};
}

// As a Grbl controller answers them, where that makes sense for a page.
MdiLines::Answer MdiLines::execute_command(const std::string& text) {
  const GrblUnits units{.axes = grbl_axes_of(machine_), .inches = false};
  if (text == "$") return told(help);
  if (text == "$G") return told(modes_text(modes(), units));
  if (text == "$#") return told(offsets_text(program_->parameters(), program_->modes(), probe_, units));
  const auto unsupported = [](const char* finer, const char* words) {
    return refused("mdi.unsupported", {.code = std::string("mdi.unsupported.") + finer, .text = words});
  };
  const bool is_setting = text == "$$" || (text.size() > 1 && text[1] >= '0' && text[1] <= '9');
  // The board's own values differ from those of the machine file.
  if ((is_setting || text == "$I") && !session_.abilities().can(Ability::step_counts)) {
    return unsupported("board-setting", "the board has its own settings: read them in the Machine tab, part Board");
  }
  if (text == "$I") return told(build_text(""));
  if (text == "$$") {
    std::string all;
    for (const GrblSetting& one : grbl_settings(machine_, {})) {
      all += fmt::format("${}={}\r\n", one.number, one.value);
    }
    return told(all);
  }
  if (text == "$H") return ask(request::Home{});
  if (text == "$SLP") return ask(request::Sleep{});
  if (text == "$X") {
    const MachineState state = session_.state();
    const bool lacks_place =
        machine_.tool_change != nullptr && state == MachineState::idle && !is_place_confirmed(session_);
    if (lacks_place || session_.lost_place()) {
      return ask(request::SetPosition{{.place = session_.status().position.place, .trust = Trust::commanded}});
    }
    if (state != MachineState::alarm && state != MachineState::fault) return told("[MSG:Nothing is locked]");
    return ask(request::ResetMachine{});
  }
  if (text.starts_with("$J=")) return unsupported("jog", "the console cannot jog: use the Setup tab");
  if (text == "$C") return unsupported("check", "the console has no check mode: open the program in the Files tab");
  if (is_setting) {
    return unsupported("setting", "settings are in the machine file: change them in the Machine tab");
  }
  const std::string word = text.substr(0, 20);
  return refused("mdi.unsupported",
                 {.code = "mdi.unsupported",
                  .arguments = {{"word", word}},
                  .text = fmt::format("the console does not support {}: it supports $$ $# $G $I $H $X $SLP", word)});
}

MdiLines::Answer MdiLines::ask(Request wanted) {
  const bool is_stream = std::holds_alternative<request::Stream>(wanted);
  const auto ticket = session_.request(std::move(wanted));
  if (!ticket) return refused(ticket.error());
  if (is_stream) ticket_ = *ticket;
  return {};
}

void MdiLines::on_change(const MachineChange& change) {
  if (change.kind == MachineChange::Kind::probed) probe_ = change.probe;
  if (change.kind == MachineChange::Kind::state &&
      (change.state == MachineState::alarm || change.state == MachineState::fault)) {
    ended_ = true;
  }
  const bool is_mine = change.kind == MachineChange::Kind::answered && ticket_ == change.ticket;
  if (is_mine) {
    ticket_.reset();
    // What was left on is off now, and stays off.
    if (!std::exchange(stops_, false)) apply_offsets();
    ++version_;
  }
  if (ended_ && !streams()) begin_anew();
}

bool MdiLines::poll() {
  if (streams() && !stops_ && session_.state() == MachineState::await_line && program_->queued() == 0 &&
      !program_->asks() && is_off(session_.status().outputs)) {
    if (const auto& wrong = program_->answer_fault(); wrong && trouble_.empty()) trouble_ = wrong->message;
    stops_ = session_.request(request::Stop{}).has_value();
  }
  const bool rests = !session_.busy() || session_.state() == MachineState::await_line;
  return rests && std::exchange(changed_, false);
}

}  // namespace passo
