#include "passo/journal/journal.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "passo/base/ensure.hpp"
#include "passo/journal/record_text.hpp"

namespace passo {
namespace {

constexpr std::string_view title = "passo journal 4\n";
// "serial executed item s item s check\n"
constexpr std::size_t place_size = 20 + 1 + 24;
constexpr std::size_t line_size = 20 + 1 + 5 + 1 + place_size + 1 + place_size + 1 + record_check_size + 1;

std::string text_of(const char* key, const FileStamp& stamp) {
  return fmt::format("{} {} {:016x} {}\n", key, stamp.size, stamp.fingerprint, record_name(stamp.name));
}

std::string text_of(std::size_t number, const ProbeOutcome& outcome) {
  std::string text = fmt::format("probe {} {:d} {:d}", number, outcome.refused, outcome.touched);
  for (const Point& place : {outcome.contact, outcome.rest}) {
    for (const Axis axis : all_axes) text += fmt::format(" {}", place[axis]);
  }
  return text;
}

std::string text_of(const JournalHead& head) {
  std::string text(title);
  text += fmt::format("made-by {}\n", record_name(head.made_by));
  text += text_of("program", head.program) + text_of("machine", head.machine);
  text += fmt::format("path {:016x}\ncounts {}", head.path, head.job_counts.size());
  for (const int count : head.job_counts) text += fmt::format(" {}", count);
  text += "\nstart";
  for (const Axis axis : all_axes) text += fmt::format(" {}", head.start[axis]);
  const SessionNumbers& numbers = head.numbers;
  text += fmt::format("\nbefore {} {}\nsession {} {}\nplace {} {}\n", numbers.session_before, numbers.executed_before,
                      numbers.greeting, numbers.session, head.place.item, head.place.s.value());
  text += fmt::format("probes {}\n", head.probes.size());
  for (std::size_t i = 0; i < head.probes.size(); ++i) text += text_of(i, head.probes[i]) + '\n';
  return text;
}

FileStamp stamp(RecordWords& words, std::string_view key) {
  words.expect(key);
  FileStamp stamp;
  stamp.size = words.number<std::uint64_t>();
  stamp.fingerprint = words.number<std::uint64_t>(16);
  stamp.name = words.name();
  return stamp;
}

PathPosition place(RecordWords& words) {
  PathPosition place;
  place.item = words.number<std::uint64_t>();
  place.s = Mm(words.real());
  return place;
}

ProbeOutcome outcome(RecordWords& words, std::size_t number) {
  words.expect("probe");
  words.expect(std::to_string(number));
  ProbeOutcome outcome;
  outcome.refused = words.number<unsigned>() != 0;
  outcome.touched = words.number<unsigned>() != 0;
  for (Point* const place : {&outcome.contact, &outcome.rest}) {
    for (const Axis axis : all_axes) (*place)[axis] = words.real();
  }
  return outcome;
}

std::optional<JournalHead> read_head(std::string_view text) {
  RecordWords words(text);
  JournalHead head;
  words.expect("made-by");
  head.made_by = words.name();
  head.program = stamp(words, "program");
  head.machine = stamp(words, "machine");
  words.expect("path");
  head.path = words.number<std::uint64_t>(16);
  words.expect("counts");
  const auto motors = words.number<std::size_t>();
  if (motors > max_motors) return {};
  for (std::size_t m = 0; m < motors; ++m) head.job_counts.push_back(words.number<int>());
  words.expect("start");
  for (const Axis axis : all_axes) head.start[axis] = words.real();
  words.expect("before");
  head.numbers.session_before = words.number<std::uint16_t>();
  head.numbers.executed_before = words.number<ItemNumber>();
  words.expect("session");
  head.numbers.greeting = words.number<std::uint8_t>();
  head.numbers.session = words.number<std::uint16_t>();
  words.expect("place");
  head.place = place(words);
  words.expect("probes");
  const auto probes = words.number<std::size_t>();
  for (std::size_t i = 0; i < probes && words.good(); ++i) head.probes.push_back(outcome(words, i));
  if (!words.good() || !words.at_end() || head.numbers.session == 0) return {};
  return head;
}

std::string line_of(std::uint64_t serial, const BoardStop& rest) {
  std::string line = fmt::format("{:20} {:5} {:20} {:24} {:20} {:24} ", serial, rest.executed, rest.place.item,
                                 rest.place.s.value(), rest.done.item, rest.done.s.value());
  line += record_check(line);
  return line + '\n';
}

struct Noted {
  std::uint64_t serial = 0;
  BoardStop rest;
};

std::optional<Noted> read_line(std::string_view line) {
  if (line.size() != line_size || line.back() != '\n') return {};
  const std::string_view checked = line.substr(0, line_size - record_check_size - 1);
  if (line.substr(checked.size(), record_check_size) != record_check(checked)) return {};
  RecordWords words(checked);
  Noted noted;
  noted.serial = words.number<std::uint64_t>();
  noted.rest.executed = words.number<ItemNumber>();
  noted.rest.place = place(words);
  noted.rest.done = place(words);
  return words.good() ? std::optional(noted) : std::nullopt;
}

// Takes the outcomes. The last line may be torn: then nothing has moved since. False: another line is damaged.
bool read_outcomes(std::string_view text, std::vector<ProbeOutcome>& outcomes) {
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1)) {
    if (end < record_check_size) return false;
    const std::string_view checked = text.substr(0, end - record_check_size);
    if (text.substr(checked.size(), record_check_size) != record_check(checked)) return false;
    RecordWords words(checked);
    const ProbeOutcome found = outcome(words, outcomes.size());
    if (!words.good()) return false;
    outcomes.push_back(found);
  }
  return true;
}

}  // namespace

void JournalWriter::begin(const JournalHead& head) {
  ensure(head.numbers.session != 0 && head.job_counts.size() <= max_motors);  // read_head() takes no other
  std::string text = text_of(head);
  end_record(text);
  head_size_ = text.size();
  noted_ = 0;
  probes_ = head.probes.size();
  const std::string blank = std::string(line_size - 1, ' ') + '\n';
  for (std::size_t i = 0; i < rests; ++i) text += blank;
  failed_ = !store_.replace(text);
}

void JournalWriter::record(const BoardStop& rest) {
  const std::size_t place = noted_ % rests;
  const std::string line = line_of(noted_, rest);
  ensure(head_size_ > 0 && line.size() == line_size);  // read_line() takes no other
  if (!failed_) failed_ = !store_.overwrite(head_size_ + place * line_size, line);
  ++noted_;
}

void JournalWriter::record(const ProbeOutcome& outcome) {
  ensure(head_size_ > 0);
  std::string line = text_of(probes_++, outcome) + ' ';
  line += record_check(line);
  if (!failed_) failed_ = !store_.append(line + '\n');
}

std::optional<Journal> Journal::read(std::string_view text) {
  const std::optional<RecordParts> parts = read_record(text, title);
  if (!parts) return {};
  std::optional<JournalHead> head = read_head(parts->body);
  if (!head) return {};
  Journal journal;
  journal.head_ = std::move(*head);
  constexpr std::size_t ring = JournalWriter::rests * line_size;
  std::string_view lines = parts->rest.substr(0, ring);
  if (!read_outcomes(parts->rest.substr(lines.size()), journal.head_.probes)) return {};
  std::vector<Noted> noted;
  for (; !lines.empty(); lines.remove_prefix(std::min(line_size, lines.size()))) {
    const std::string_view line = lines.substr(0, line_size);
    if (const auto one = read_line(line)) {
      noted.push_back(*one);
    } else if (line.find_first_not_of(" \n") != std::string_view::npos || line.size() != line_size) {
      ++journal.torn_;
    }
  }
  std::sort(noted.begin(), noted.end(), [](const Noted& a, const Noted& b) { return a.serial > b.serial; });
  for (const Noted& one : noted) journal.rests_.push_back(one.rest);
  return journal;
}

bool Journal::is_journal(std::string_view text) {
  return text.starts_with(title.substr(0, title.find_last_of(' ')));
}

// Items are sent only after the board has heard the hello and the session's number. If the board then seems not to have
// heard them, it was reset.
SessionNumbers::Stage Journal::stage_of(const BoardStatus& status) const {
  return head_.numbers.stage_of(status, rests_.empty() && torn_ == 0);
}

// The motion that a line calls done may still lag by a segment. When the next line is noted, a refill later, it is
// done.
PathPosition Journal::done() const {
  return rests_.size() < 2 ? head_.place : rests_[1].done;
}

PathPosition Journal::farthest() const {
  return rests_.empty() ? head_.place : rests_.front().place;
}

std::optional<PathPosition> Journal::place_of(const BoardStatus& status) const {
  using Stage = SessionNumbers::Stage;
  switch (stage_of(status)) {
    case Stage::another: return {};
    case Stage::before_hello:
    case Stage::before_session: return head_.place;
    case Stage::in_session: break;
  }
  const auto found = std::find_if(rests_.begin(), rests_.end(),
                                  [&](const BoardStop& rest) { return rest.executed == status.executed; });
  if (found != rests_.end()) return found->place;
  // No items were sent, or none arrived.
  const SessionNumbers& numbers = head_.numbers;
  const ItemNumber first = numbers.greeting != 0 ? numbers.greeting : numbers.executed_before;
  if (status.executed == first) return head_.place;
  return {};
}

}  // namespace passo
