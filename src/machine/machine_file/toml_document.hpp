// TomlDocument: a TOML file as a plain tree, in the order of the file. Every key and value has its place.
//
// Only toml_document.cpp and toml_text.cpp see the TOML library: the library compiles slowly, and its exceptions stay
// there.
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
  std::vector<TomlEntry> entries;  // in the order of the file
};
using TomlArray = std::vector<TomlValue>;
// A date or a time. No key of a machine file takes one.
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
// The kind of a value, for a message: "a number", "the text \"25 mm\"".
std::string kind_of(const TomlValue& value);

struct TomlDocument {
  TomlTable root;
  bool complete = true;  // false: lines with errors were left out, so a key that seems missing may be in one of them
};

// Every syntax error goes to the reporter. A wrong line is left out, and the rest is read again.
TomlDocument parse_toml(std::string text, const TomlReporter& reporter);

}  // namespace passo
