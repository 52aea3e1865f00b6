// A strict reader of value change dumps, for tests. It refuses errors that a viewer would accept.
#pragma once

#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace passo {

struct VcdChange {
  std::uint64_t time = 0;
  std::uint64_t value = 0;
  friend bool operator==(const VcdChange&, const VcdChange&) = default;
};

class Vcd {
 public:
  explicit Vcd(const std::string& text) : words_(text) {
    read_header();
    expect("#0");
    expect("$dumpvars");
    while (word() != "$end") read_change(word_);
    for (const auto& [code, wire] : by_code_) {
      if (wires[wire].size() != 1) fail("no initial value for " + wire);
    }
    while (words_ >> word_) {
      if (word_[0] != '#') {
        read_change(word_);
        continue;
      }
      const std::uint64_t time = std::stoull(word_.substr(1));
      if (time <= end) fail("time goes back or stands still: " + word_);
      end = time;
    }
  }

  // All changes of each wire, the initial value first.
  std::map<std::string, std::vector<VcdChange>> wires;
  std::vector<std::string> names;  // in the order of declaration
  std::string timescale;
  std::string scope;
  std::uint64_t end = 0;

  std::uint64_t value(const std::string& wire, std::uint64_t time) const {
    std::uint64_t value = 0;
    for (const VcdChange& change : wires.at(wire)) {
      if (change.time <= time) value = change.value;
    }
    return value;
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw std::runtime_error("VCD: " + what); }
  std::string word() {
    if (!(words_ >> word_)) fail("ends too early");
    return word_;
  }
  void expect(const std::string& wanted) {
    if (word() != wanted) fail("'" + word_ + "' in the place of '" + wanted + "'");
  }

  void read_header() {
    expect("$version");
    while (word() != "$end") {
    }
    expect("$timescale");
    const std::string number = word();
    timescale = number + " " + word();
    expect("$end");
    expect("$scope");
    expect("module");
    scope = word();
    expect("$end");
    while (word() == "$var") {
      expect("wire");
      const int bits = std::stoi(word());
      const std::string code = word();
      const std::string name = word();
      expect("$end");
      if (!by_code_.emplace(code, name).second) fail("two wires with the code " + code);
      if (!wires.emplace(name, std::vector<VcdChange>()).second) fail("two wires named " + name);
      bits_[name] = bits;
      names.push_back(name);
    }
    if (word_ != "$upscope") fail(word_);
    expect("$end");
    expect("$enddefinitions");
    expect("$end");
  }

  void read_change(const std::string& token) {
    const bool vector = token[0] == 'b';
    const std::string digits = vector ? token.substr(1) : token.substr(0, 1);
    const std::string code = vector ? word() : token.substr(1);
    if (digits.find_first_not_of("01") != std::string::npos) fail("bad value " + token);
    if (!by_code_.contains(code)) fail("unknown wire " + code);
    const std::string& name = by_code_[code];
    if (static_cast<int>(digits.size()) != bits_[name]) fail("wrong number of bits for " + name);
    const std::uint64_t value = std::stoull(digits, nullptr, 2);
    std::vector<VcdChange>& changes = wires[name];
    if (!changes.empty() && changes.back().value == value) fail(name + " changes to what it is");
    if (!changes.empty() && changes.back().time == end && end != 0) fail(name + " changes twice at once");
    changes.push_back({end, value});
  }

  std::istringstream words_;
  std::string word_;
  std::map<std::string, std::string> by_code_;
  std::map<std::string, int> bits_;
};

}  // namespace passo
