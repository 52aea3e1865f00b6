// Reads a value change dump: IEEE 1364-2005, 18.
#include <array>
#include <limits>
#include <map>
#include <vector>

#include "signals_file.hpp"

namespace passo {
namespace {

constexpr std::uint64_t femtoseconds_a_nanosecond = 1'000'000;

// "1 ns", "100ps" in femtoseconds; 0: it is none.
std::uint64_t femtoseconds_of(const std::string& text) {
  std::uint64_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || (number != 1 && number != 10 && number != 100)) return 0;
  std::uint64_t factor = 1;
  for (const std::string_view unit : {"fs", "ps", "ns", "us", "ms", "s"}) {
    if (std::string_view(rest) == unit) return number * factor;
    factor *= 1000;
  }
  return 0;
}

class VcdFile {
 public:
  explicit VcdFile(SignalsFile& file) : file_(file) {}

  bool read() {
    while (next_word()) {
      const bool good = word_[0] == '$' ? on_command() : on_value();
      if (is_over_) return true;
      if (!good) return false;
    }
    return !in_header_ || file_.fail("the file ends; expected $enddefinitions, which ends the header of a VCD");
  }

 private:
  bool next_word() {
    while (true) {
      const std::string_view rest = file_.line().substr(std::min(place_, file_.line().size()));
      const std::size_t begin = rest.find_first_not_of(" \t");
      if (begin != std::string_view::npos) {
        const std::string_view from = rest.substr(begin);
        word_ = from.substr(0, from.find_first_of(" \t"));
        place_ += begin + word_.size();
        return true;
      }
      if (!file_.next_line()) return false;
      place_ = 0;
    }
  }

  // The words up to $end.
  bool read_words(const std::string& command, std::vector<std::string>& words) {
    while (next_word()) {
      if (word_ == "$end") return true;
      words.push_back(word_);
    }
    return file_.fail("the file ends; expected $end after " + command);
  }

  bool on_command() {
    // Commands around values, which are read as all others.
    for (const char* around : {"$dumpvars", "$dumpall", "$dumpon", "$dumpoff", "$end"}) {
      if (!in_header_ && word_ == around) return true;
    }
    const std::string command = word_;
    std::vector<std::string> words;
    if (!read_words(command, words)) return false;
    if (command == "$timescale") {
      std::string all;
      for (const std::string& word : words) all += word;
      unit_ = femtoseconds_of(all);
      return unit_ != 0 || file_.fail(fmt::format("expected a $timescale such as 1 ns or 100 ps, got '{}'", all));
    }
    if (command == "$var") return add_signal(words);
    if (command == "$enddefinitions") {
      in_header_ = false;
      return unit_ != 0 || file_.fail("expected a $timescale, e.g. $timescale 1 ns $end, before $enddefinitions");
    }
    return true;
  }

  bool add_signal(const std::vector<std::string>& words) {
    if (words.size() < 4) return file_.fail("expected $var TYPE BITS CODE NAME $end");
    std::vector<std::size_t>& numbers = by_code_[words[2]];
    if (words[1] == "1") numbers.push_back(file_.add(words[3]));
    return true;
  }

  bool on_value() {
    const std::string got = word_;
    if (in_header_) return file_.fail(fmt::format("expected a command of a VCD's header, e.g. $var, got '{}'", got));
    switch (got[0]) {
      case '#': return on_time();
      case '0':
      case '1':
      case 'x':
      case 'X':
      case 'z':
      case 'Z': return set(got.substr(1), got[0] == '1');
      case 'b':
      case 'B':
      case 'r':
      case 'R':
      case 's':
      case 'S':
        if (!next_word()) return file_.fail(fmt::format("the file ends; expected a signal's code after {}", got));
        return set(word_, got.ends_with('1') && got[0] != 'r' && got[0] != 's');
      default:
        return file_.fail(fmt::format("expected #TIME, or 0 or 1 with the code of a signal, e.g. 1!, got '{}'", got));
    }
  }

  bool on_time() {
    std::uint64_t time = 0;
    const char* const end = word_.data() + word_.size();
    const auto [rest, error] = std::from_chars(word_.data() + 1, end, time);
    if (error != std::errc{} || rest != end) return file_.fail(fmt::format("expected #TIME, got '{}'", word_));
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (unit_ >= femtoseconds_a_nanosecond) {
      const std::uint64_t factor = unit_ / femtoseconds_a_nanosecond;
      if (time > most / factor) return file_.fail(fmt::format("expected a time below 292 years, got '{}'", word_));
      time *= factor;
    } else {
      time /= femtoseconds_a_nanosecond / unit_;
    }
    const auto at = static_cast<std::int64_t>(std::min(time, most));
    if (at < now_) return file_.fail(fmt::format("expected a time that is not before the last one, got '{}'", word_));
    now_ = at;
    is_over_ = !file_.pass_to(at);
    return true;
  }

  bool set(const std::string& code, bool high) {
    const auto signals = by_code_.find(code);
    if (signals == by_code_.end()) {
      return file_.fail(fmt::format("expected the code of a signal from the header, got '{}'", code));
    }
    for (const std::size_t signal : signals->second) {
      if (!file_.set(signal, now_, high)) return false;
    }
    return true;
  }

  SignalsFile& file_;
  std::string word_;
  std::size_t place_ = 0;   // in the line
  std::uint64_t unit_ = 0;  // in femtoseconds
  bool in_header_ = true;
  bool is_over_ = false;
  std::int64_t now_ = 0;
  std::map<std::string, std::vector<std::size_t>> by_code_;
};

}  // namespace

bool read_vcd(SignalsFile& file) {
  return VcdFile(file).read();
}

}  // namespace passo
