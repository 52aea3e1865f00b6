// What the tests of all formats need: an import of a text or of an example, with its machine.
#pragma once

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "passo/controller_file/controller_file.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

struct Imported {
  Diagnostics diagnostics;
  std::optional<ImportedMachine> result;
  std::optional<MachineDescription> machine;  // the result, as our reader reads it

  const AxisDescription& axis(Axis letter) const {
    return *std::ranges::find(machine->axes, letter, &AxisDescription::axis);
  }
  std::string target_of(const std::string& source) const {
    const auto value = std::ranges::find(result->understood, source, &UnderstoodValue::source);
    return value == result->understood.end() ? "" : value->target;
  }
  std::string reason_of(const std::string& source) const {
    const auto value = std::ranges::find(result->unmapped, source, &UnmappedValue::source);
    return value == result->unmapped.end() ? "(is not listed)" : value->reason;
  }
  bool warns_of(const std::string& words) const {
    return std::ranges::any_of(result->warnings,
                               [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  }
  std::string first_code() const { return diagnostics.all().empty() ? "" : diagnostics.all().front().code; }
  const Diagnostic& first() const { return diagnostics.all().front(); }
};

inline Imported imported(const std::string& text, std::optional<ImportFormat> format = {}) {
  Imported it;
  it.result = import_controller_text({.file = "source", .text = text}, format, it.diagnostics);
  Diagnostics wrong;
  if (it.result) it.machine = parse_machine(it.result->toml, "made.toml", wrong, MachineUse::any_board);
  EXPECT_EQ(it.result.has_value(), it.machine.has_value()) << render(wrong, false);
  return it;
}

inline std::string example_text(const std::string& name) {
  std::ifstream file(PASSO_SOURCE_DIR "/src/machine/controller_file/fuzz/corpus/" + name, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_FALSE(text.empty()) << name;
  return text;
}

inline Imported imported_example(const std::string& name) {
  Imported it = imported(example_text(name));
  EXPECT_TRUE(it.machine.has_value()) << name << "\n" << render(it.diagnostics, false);
  return it;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& by) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), by);
}

}  // namespace passo::test
