// TomlDocument: a TOML file as a plain tree, in the order of the file. Every key and value has its position.
//
// Only toml_document.cpp and toml_text.cpp include the TOML library, because it compiles slowly and throws exceptions,
// which stay inside these files.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/toml/toml_reporter.hpp"

namespace passo {

struct TomlEntry;
struct TomlValue;

struct TomlTable {
  std::vector<TomlEntry> entries;  // in the order of the file
};
using TomlArray = std::vector<TomlValue>;
// A date or a time. No key of a machine file accepts one.
struct TomlDate {};

struct TomlValue {
  std::variant<TomlDate, bool, double, std::string, TomlArray, TomlTable> content;
  SourceLocation place;
};

struct TomlEntry {
  std::string key;
  SourceLocation place;  // position of the key
  TomlValue value;
};

const TomlEntry* find(const TomlTable& table, std::string_view key);
// Returns the kind of a value, for a message: "a number", "the text \"25 mm\"".
std::string kind_of(const TomlValue& value);

struct TomlDocument {
  TomlTable root;
  bool complete = true;  // false: lines with errors were omitted, so a key that seems missing may be in one of them
};

// Passes every syntax error to the reporter. A line with an error is omitted, and the remaining lines are parsed again.
TomlDocument parse_toml(std::string text, const TomlReporter& reporter);

}  // namespace passo
