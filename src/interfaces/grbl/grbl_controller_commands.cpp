// GrblController: lines that begin with $.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/grbl/grbl_controller.hpp"
#include "passo/grbl/grbl_enumerations.hpp"
#include "passo/interpreter/grbl_errors.hpp"

namespace passo {
namespace {

constexpr std::size_t build_words_from = 3;  // after "$I="

// "$HX"
std::optional<Axis> single_axis_of(std::string_view text) {
  return text.size() == 3 && text.starts_with("$H") ? axis_of(text[2]) : std::nullopt;
}

// Units, distances and places: no other code belongs into a jog.
bool is_jog(std::string_view words) {
  if (words.find_first_of("IJKLMPRST$") != std::string_view::npos) return false;
  for (std::size_t at = 0; (at = words.find('G', at)) != std::string_view::npos;) {
    const std::size_t end = std::min(words.find_first_not_of("0123456789.", ++at), words.size());
    const std::string_view code = words.substr(at, end - at);
    if (code != "20" && code != "21" && code != "53" && code != "90" && code != "91") return false;
  }
  return true;
}

// grblHAL's settings of the retract in a hold. The machine file has a park position for the end of programs only.
bool is_parking(int number) {
  return number == 41 || number == 42 || (number >= 56 && number <= 59);
}

bool is_same_number(const std::string& a, const std::string& b) {
  constexpr double shown = 0.0006;  // three decimals
  double first = 0;
  double second = 0;
  const auto one = std::from_chars(a.data(), a.data() + a.size(), first);
  const auto other = std::from_chars(b.data(), b.data() + b.size(), second);
  return one.ec == std::errc() && other.ec == std::errc() && std::abs(first - second) <= shown;
}

// The value of a setting of the board, or what a sender has chosen for itself.
std::string with_choice(int number, std::string value, const GrblChoices& choices) {
  if (number == 10) return fmt::format("{}", choices.status_mask);
  if (number == 13) return choices.inches ? "1" : "0";
  return value;
}

}  // namespace

void GrblController::handle_command(const std::string& text) {
  if (text == "$") {
    say(help_text());
    return answer(GrblError::none);
  }
  if (text == "$G") {
    say(modes_text(program_.modes(), units()));
    return answer(GrblError::none);
  }
  if (const auto lines = enumeration_of(text)) {
    say(*lines);
    return answer(GrblError::none);
  }
  if (text == "$X") return unlock();
  if (text == "$C") return toggle_check();
  if (text.starts_with(jog_begins)) return handle_jog(text.substr(jog_begins.size()));
  // All others only at rest, as in grbl. Settings are shown in check mode and asleep too.
  const bool stands = !session_.busy() || session_.state() == MachineState::await_line;
  const bool at_rest = is_idle() || (alarm_ && stands);
  const bool shows = text == "$$" && (checks_ || session_.state() == MachineState::sleep) && !due_.is_due();
  if (!at_rest && !shows) return answer(GrblError::not_idle);
  if (text == "$$") {
    std::string all;
    for (const GrblSetting& setting : all_settings()) {
      all += fmt::format("${}={}\r\n", setting.number, setting.value);
    }
    say(std::move(all));
    return answer(GrblError::none);
  }
  if (text == "$#") {
    say(offsets_text(program_.parameters(), program_.modes(), probe_, units()));
    return answer(GrblError::none);
  }
  if (text == "$I" || text == "$I+") {
    say(build_text(store_.memory().build));
    if (text == "$I+") say(more_build_text(axis_letters(units().axes)));
    return answer(GrblError::none);
  }
  if (text.starts_with("$I=")) return handle_build_info(text.substr(build_words_from));
  if (text == "$H") return home({});
  if (const auto axis = single_axis_of(text); axis && session_.abilities().can(Ability::home_axis)) return home(axis);
  if (text == "$SLP") return sleep();
  if (text.starts_with("$N")) return handle_startup_line(text);
  if (text.starts_with("$RST=")) return restore(text);
  handle_setting(text);
}

// As in grblHAL: in each state.
std::optional<std::string> GrblController::enumeration_of(const std::string& text) const {
  if (!text.starts_with("$E")) return {};
  return grbl_enumeration(text, all_settings(), axis_letters(units().axes), session_.numbered_settings() == nullptr);
}

void GrblController::unlock() {
  if (alarm_) {
    const MachineState state = session_.state();
    if (state == MachineState::alarm || state == MachineState::fault) return answer(GrblError::locked);
    if (is_door_open()) return answer(GrblError::door_open);
    if (session_.lost_place() && !state_place()) return answer(GrblError::locked);
    alarm_ = false;
    say("[MSG:Caution: Unlocked]\r\n");
  }
  answer(GrblError::none);
}

// The machine stands where it is shown.
bool GrblController::state_place() {
  const Point place = session_.status().position.place;
  return session_.request(request::SetPosition{{.place = place, .trust = Trust::commanded}}).has_value();
}

void GrblController::toggle_check() {
  if (checks_) {
    say("[MSG:Disabled]\r\n");
    answer(GrblError::none);
    return reset();
  }
  if (!is_idle()) return answer(GrblError::not_idle);
  checks_ = true;
  say("[MSG:Enabled]\r\n");
  answer(GrblError::none);
}

void GrblController::handle_jog(const std::string& text) {
  const bool at_rest = is_idle();
  if (!at_rest && !(jogs() && !alarm_)) return answer(GrblError::not_idle);
  if (!is_jog(text)) return answer(GrblError::bad_jog);
  if (text.find_first_of("XYZABCUVW") == std::string::npos) return answer(GrblError::no_axis_words);
  const auto wrong = program_.add_jog(text, session_.now());
  if (!wrong) {
    begin_stream();
    return answer(GrblError::none);
  }
  if (wrong->code == travel_exceeded) return answer(GrblError::jog_beyond_travel);
  answer(grbl_error_number(wrong->code).value_or(static_cast<int>(GrblError::bad_jog)));
}

// What the program has left open ends first; the spindle stops.
void GrblController::home(std::optional<Axis> axis) {
  if (machine_.homing.empty()) return answer(GrblError::setting_disabled);
  if (is_door_open()) return answer(GrblError::door_open);
  due_.wait_for_rest([this, axis] { begin_homing(axis); });
  stop_machine();
}

void GrblController::begin_homing(std::optional<Axis> axis) {
  const auto ticket = session_.request(request::Home{.axis = axis});
  if (!ticket) return answer(GrblError::locked);
  due_.wait_for_homing(*ticket);
}

void GrblController::sleep() {
  say("[MSG:Sleeping]\r\n");
  due_.wait_for_rest([this] {
    ask(request::Sleep{});
    answer(GrblError::none);
  });
  stop_machine();
}

void GrblController::handle_startup_line(const std::string& text) {
  if (text == "$N") {
    say(fmt::format("$N0={}\r\n$N1={}\r\n", store_.memory().startup[0], store_.memory().startup[1]));
    return answer(GrblError::none);
  }
  const bool is_good = text.size() >= 4 && (text[2] == '0' || text[2] == '1') && text[3] == '=';
  if (!is_good) return answer(GrblError::bad_statement);
  if (alarm_) return answer(GrblError::not_idle);
  const std::string line = text.substr(4);
  if (line.size() > GrblMemory::longest) return answer(GrblError::line_too_long_to_keep);
  if (const auto wrong = line.empty() ? std::nullopt : program_.judge(line)) {
    return answer(number_of(*wrong));
  }
  GrblMemory memory = store_.memory();
  memory.startup[text[2] == '0' ? 0 : 1] = line;
  answer(keep_memory(memory) ? GrblError::none : GrblError::bad_statement);
}

// Senders and shops tell machines apart by these words, which stand in the answer to $I.
void GrblController::handle_build_info(const std::string& text) {
  if (text.size() > GrblMemory::longest) return answer(GrblError::line_too_long_to_keep);
  GrblMemory memory = store_.memory();
  memory.build = text;
  answer(keep_memory(memory) ? GrblError::none : GrblError::bad_statement);
}

// False, with a message: nothing has changed.
bool GrblController::keep_memory(const GrblMemory& memory) {
  if (store_.keep(memory)) return true;
  say("[MSG:Nothing was changed: the file cannot be written]\r\n");
  return false;
}

bool GrblController::is_door_open() const {
  return (session_.status().inputs & input_door) != 0;
}

// The settings of the machine file stay as they are: they describe the machine. What a sender has chosen for itself
// ($10, $13) and has set (offsets, start lines, the build's words) goes back to what it was. A reset follows, as in
// grbl.
void GrblController::restore(const std::string& text) {
  const bool all = text == "$RST=*";
  const bool settings = all || text == "$RST=$";
  if (!settings && text != "$RST=#") return answer(GrblError::bad_statement);
  GrblMemory memory = all ? GrblMemory() : store_.memory();
  memory.choices = GrblChoices();
  if (settings && !keep_memory(memory)) return answer(GrblError::bad_statement);
  if (text != "$RST=$") {
    apply_offsets({});
    static_cast<void>(program_.add_line("G92.1", session_.now()));
    offsets_changed_ = true;
  }
  say("[MSG:Restoring defaults]\r\n");
  answer(GrblError::none);
  reset();
}

void GrblController::handle_setting(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  int number = 0;
  const char* const last = text.data() + equals;
  const auto [end, error] = std::from_chars(text.data() + 1, last, number);
  if (error != std::errc()) {
    const bool is_command = text.find_first_of("$GCXJ#HSIR", 1) == 1;
    return answer(is_command ? GrblError::bad_statement : GrblError::bad_number);
  }
  if (end != last || equals == text.size()) return answer(GrblError::bad_statement);
  double value = 0;
  const char* const value_last = text.data() + text.size();
  const auto [value_end, value_error] = std::from_chars(last + 1, value_last, value);
  if (value_error != std::errc() || !std::isfinite(value)) return answer(GrblError::bad_number);
  if (value_end != value_last) return answer(GrblError::bad_statement);
  if (value < 0) return answer(GrblError::negative_value);
  GrblMemory memory = store_.memory();
  if (number == 10) {
    memory.choices.status_mask = static_cast<unsigned>(std::lround(std::min(value, 255.0)));
  } else if (number == 13) {
    memory.choices.inches = value != 0;
  } else if (session_.numbered_settings() == nullptr && is_parking(number)) {
    say("[MSG:Parking is not supported: a hold leaves the tool where it is]\r\n");
    return answer(GrblError::bad_statement);
  } else if (session_.numbered_settings() != nullptr) {
    return write_to_board(number, text.substr(equals + 1));
  } else {
    return keep_setting(number, value);
  }
  answer(keep_memory(memory) ? GrblError::none : GrblError::bad_statement);
}

// Those of the board, if it has its own. How a sender wants its reports is no matter of the board.
std::vector<GrblSetting> GrblController::all_settings() const {
  const GrblChoices& choices = store_.memory().choices;
  const NumberedSettings* const board = session_.numbered_settings();
  if (board == nullptr) return grbl_settings(store_.machine(), choices);
  std::vector<GrblSetting> all;
  for (auto& [number, value] : board->all()) all.push_back({number, with_choice(number, std::move(value), choices)});
  return all;
}

// What the lines before have left open ends first; the spindle stops.
void GrblController::write_to_board(int number, const std::string& value) {
  const auto all = session_.numbered_settings()->all();
  const auto found = std::ranges::find(all, number, &std::pair<int, std::string>::first);
  if (found == all.end()) return answer(GrblError::bad_statement);
  // A sender that writes back what it has read changes nothing, and wears no memory.
  if (is_same_number(found->second, value)) return answer(GrblError::none);
  due_.wait_for_rest([this, number, value] {
    session_.numbered_settings()->write(number, value);
    due_.wait_for_setting();
  });
  stop_machine();
}

// A sender that has reset the controller in the meantime waits for no answer.
void GrblController::end_write(const std::string& trouble) {
  if (!due_.waits_for_setting()) return;
  due_.call_off();
  if (!trouble.empty()) say(fmt::format("[MSG:{}]\r\n", trouble));
  answer(trouble.empty() ? GrblError::none : GrblError::bad_statement);
}

// The machine goes on with what it began with: its place is counted in steps of that.
void GrblController::keep_setting(int number, double value) {
  // A sender that writes back what it has read changes nothing.
  if (has_setting(store_.machine(), store_.memory().choices, number, value)) return answer(GrblError::none);
  if (!store_.keeps_settings()) return answer(GrblError::bad_statement);
  if (const auto reason = store_.keep(number, value)) {
    say(fmt::format("[MSG:{}]\r\n", *reason));
    return answer(GrblError::bad_statement);
  }
  say("[MSG:Saved in the machine file, takes effect at the next start]\r\n");
  answer(GrblError::none);
}

}  // namespace passo
