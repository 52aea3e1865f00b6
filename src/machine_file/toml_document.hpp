// TomlDocument: a TOML file as a plain tree, in the order of the file, every key and value with its place.
//
// The only file that sees the TOML library is toml_document.cpp: it compiles slowly, and its exceptions stay there.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "toml_reporter.hpp"

namespace passo {

struct TomlEntry;
struct TomlValue;

struct TomlTable {
  std::vector<TomlEntry> entries;  // by place in the file
};
using TomlArray = std::vector<TomlValue>;
// A date or a time: nothing in a machine file is one.
struct TomlDate {};

struct TomlValue {
  std::variant<TomlDate, bool, double, std::string, TomlArray, TomlTable> content;
  SourcePlace place;
};

struct TomlEntry {
  std::string key;
  SourcePlace place;  // of the key
  TomlValue value;
};

const TomlEntry* find(const TomlTable& table, std::string_view key);
// "a number", "the text \"25 mm\"": what a value is, for a message.
std::string kind_of(const TomlValue& value);

struct TomlDocument {
  TomlTable root;
  bool complete = true;  // false: lines with errors were left out, so a missing key need not be missing
};

// Every syntax error goes to the reporter: a line that is wrong is left out and the rest is read again.
TomlDocument parse_toml(std::string text, const TomlReporter& reporter);

}  // namespace passo
