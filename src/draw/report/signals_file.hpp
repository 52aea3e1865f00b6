// SignalsFile: the lines of a file with signals, and the signals that were read from it so far. For the readers of both
// formats.
#pragma once

#include <algorithm>
#include <charconv>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "passo/report/signals_reader.hpp"

namespace passo {

class SignalsFile {
 public:
  SignalsFile(std::istream& in, const std::string& path, const SignalsToRead& what)
      : in_(in), path_(path), what_(what) {}

  bool next_line() {
    if (!std::getline(in_, line_)) return false;
    ++number_;
    if (line_.ends_with('\r')) line_.pop_back();
    return true;
  }
  std::string_view line() const { return line_; }

  // Always false.
  bool fail(const std::string& expected) {
    error_ = fmt::format("{}:{}: {}", path_, std::max<std::size_t>(number_, 1), expected);
    return false;
  }
  const std::string& error() const { return error_; }

  Signals& signals() { return signals_; }
  // Adds a signal. Returns its number.
  std::size_t add(std::string_view name) {
    signals_.signals.push_back({std::string(name)});
    wanted_.push_back(what_.wanted(name));
    levels_.push_back(false);
    return levels_.size() - 1;
  }
  // False at the first time that is not read any more.
  bool pass_to(std::int64_t at) {
    signals_.end = std::min(at, what_.until);
    return at <= what_.until;
  }
  // The signal has this level from `at` on. False: there are too many changes.
  bool set(std::size_t signal, std::int64_t at, bool high) {
    if (!wanted_[signal] || levels_[signal] == high) return true;
    levels_[signal] = high;
    signals_.signals[signal].changes.push_back({at, high});
    return ++changes_ <= what_.most_changes ||
           fail(fmt::format("expected at most {} changes of the signals in use; there are more after {:.6f} s",
                            what_.most_changes, static_cast<double>(at) * 1e-9));
  }

 private:
  std::istream& in_;
  const std::string& path_;
  const SignalsToRead& what_;
  std::string line_;
  std::size_t number_ = 0;
  std::string error_;
  Signals signals_;
  std::vector<bool> wanted_;
  std::vector<bool> levels_;
  std::size_t changes_ = 0;
};

// Both read all of the file; false, and the file's error(), if they cannot.
bool read_vcd(SignalsFile& file);
bool read_csv(SignalsFile& file);

}  // namespace passo
