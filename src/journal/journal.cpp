#include "passo/journal/journal.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/base/fingerprint.hpp"

namespace passo {
namespace {

constexpr std::string_view title = "passo journal 1\n";
constexpr std::string_view check_word = "check ";
constexpr std::size_t check_size = 16;  // hexadecimal digits
// "serial executed item s check\n"
constexpr std::size_t line_size = 20 + 1 + 5 + 1 + 20 + 1 + 24 + 1 + check_size + 1;

std::string check_of(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fmt::format("{:016x}", fingerprint.value());
}

// A file name, made to fit on one line.
std::string escaped(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == '%' || static_cast<unsigned char>(c) < ' ') {
      text += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    } else {
      text += c;
    }
  }
  return text;
}

// Reads words of a text, one after the other. The first wrong word makes the whole text bad.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  template <class T>
  T number(int base = 10) {
    const std::string_view word = next();
    T value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
    take(end == word.data() + word.size() && error == std::errc());
    return value;
  }
  double real() {
    const std::string_view word = next();
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    take(end == word.data() + word.size() && error == std::errc() && std::isfinite(value));
    return value;
  }
  void expect(std::string_view word) { take(next() == word); }
  // Reads to the end of the line, after one blank.
  std::string name() {
    const std::size_t end = text_.find('\n');
    take(end != std::string_view::npos && text_.starts_with(' '));
    if (!good_) return {};
    const std::string_view all = text_.substr(1, end - 1);
    text_.remove_prefix(end);
    std::string plain;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] != '%') {
        plain += all[i];
        continue;
      }
      Words code(all.substr(i + 1, 2));
      plain += static_cast<char>(code.number<std::uint8_t>(16));
      take(code.good());
      i += 2;
    }
    return plain;
  }
  bool good() const { return good_; }
  bool at_end() const { return text_.find_first_not_of(" \n") == std::string_view::npos; }

 private:
  std::string_view next() {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \n"), text_.size()));
    const std::string_view word = text_.substr(0, std::min(text_.find_first_of(" \n"), text_.size()));
    text_.remove_prefix(word.size());
    return word;
  }
  void take(bool good) { good_ = good_ && good; }

  std::string_view text_;
  bool good_ = true;
};

std::string text_of(const char* key, const FileStamp& stamp) {
  return fmt::format("{} {} {:016x} {}\n", key, stamp.size, stamp.fingerprint, escaped(stamp.name));
}

std::string text_of(const JournalHead& head) {
  std::string text(title);
  text += fmt::format("made-by {}\n", escaped(head.made_by));
  text += text_of("program", head.program) + text_of("machine", head.machine);
  text += fmt::format("path {:016x}\ncounts {}", head.path, head.job_counts.size());
  for (const int count : head.job_counts) text += fmt::format(" {}", count);
  text += fmt::format("\nbefore {} {}\nsession {} {}\nplace {} {}\n", head.session_before, head.executed_before,
                      head.greeting, head.session, head.place.item, head.place.s.value());
  return text;
}

FileStamp stamp(Words& words, std::string_view key) {
  words.expect(key);
  FileStamp stamp;
  stamp.size = words.number<std::uint64_t>();
  stamp.fingerprint = words.number<std::uint64_t>(16);
  stamp.name = words.name();
  return stamp;
}

PathPlace place(Words& words) {
  PathPlace place;
  place.item = words.number<std::uint64_t>();
  place.s = Mm(words.real());
  return place;
}

std::optional<JournalHead> read_head(std::string_view text) {
  Words words(text);
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
  words.expect("before");
  head.session_before = words.number<std::uint16_t>();
  head.executed_before = words.number<ItemNumber>();
  words.expect("session");
  head.greeting = words.number<std::uint8_t>();
  head.session = words.number<std::uint16_t>();
  words.expect("place");
  head.place = place(words);
  if (!words.good() || !words.at_end() || head.session == 0) return {};
  return head;
}

std::string line_of(std::uint64_t serial, const BoardRest& rest) {
  std::string line =
      fmt::format("{:20} {:5} {:20} {:24} ", serial, rest.executed, rest.place.item, rest.place.s.value());
  line += check_of(line);
  return line + '\n';
}

struct Noted {
  std::uint64_t serial = 0;
  BoardRest rest;
};

std::optional<Noted> read_line(std::string_view line) {
  if (line.size() != line_size || line.back() != '\n') return {};
  const std::string_view checked = line.substr(0, line_size - check_size - 1);
  if (line.substr(checked.size(), check_size) != check_of(checked)) return {};
  Words words(checked);
  Noted noted;
  noted.serial = words.number<std::uint64_t>();
  noted.rest.executed = words.number<ItemNumber>();
  noted.rest.place = place(words);
  return words.good() ? std::optional(noted) : std::nullopt;
}

}  // namespace

void JournalWriter::begin(const JournalHead& head) {
  std::string text = text_of(head);
  text += fmt::format("{}{}\n", check_word, check_of(text));
  head_size_ = text.size();
  noted_ = 0;
  const std::string blank = std::string(line_size - 1, ' ') + '\n';
  for (std::size_t i = 0; i < rests; ++i) text += blank;
  failed_ = !store_.replace(text);
}

void JournalWriter::note(const BoardRest& rest) {
  const std::size_t place = noted_ % rests;
  if (!failed_) failed_ = !store_.overwrite(head_size_ + place * line_size, line_of(noted_, rest));
  ++noted_;
}

std::optional<Journal> Journal::read(std::string_view text) {
  if (!text.starts_with(title)) return {};
  const std::size_t check = text.find(std::string("\n").append(check_word));
  if (check == std::string_view::npos) return {};
  const std::string_view checked = text.substr(0, check + 1);
  const std::string_view digits = text.substr(checked.size() + check_word.size(), check_size + 1);
  if (digits != check_of(checked) + '\n') return {};
  std::optional<JournalHead> head = read_head(checked.substr(title.size()));
  if (!head) return {};
  Journal journal;
  journal.head_ = std::move(*head);
  std::string_view lines = text.substr(checked.size() + check_word.size() + digits.size());
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

Journal::State Journal::state_of(const BoardStatus& status) const {
  if (status.session == head_.session) return State::in_session;
  // Items are sent only after the board has heard the hello and the session's number. If the board now seems not to
  // have heard them, it was reset.
  if (!rests_.empty() || torn_ > 0) return State::another;
  const bool greeted = head_.greeting != 0 && status.session == 0 && status.motors != 0;
  if (greeted && status.executed == head_.greeting) return State::before_session;
  const bool as_before = status.session == head_.session_before && status.executed == head_.executed_before;
  return as_before ? State::before_hello : State::another;
}

std::optional<PathPlace> Journal::place_of(const BoardStatus& status) const {
  switch (state_of(status)) {
    case State::another: return {};
    case State::before_hello:
    case State::before_session: return head_.place;
    case State::in_session: break;
  }
  const auto found = std::find_if(rests_.begin(), rests_.end(),
                                  [&](const BoardRest& rest) { return rest.executed == status.executed; });
  if (found != rests_.end()) return found->place;
  // No items were sent, or none arrived.
  const ItemNumber first = head_.greeting != 0 ? head_.greeting : head_.executed_before;
  if (status.executed == first) return head_.place;
  return {};
}

}  // namespace passo
