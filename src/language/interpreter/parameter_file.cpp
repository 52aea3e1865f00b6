#include "passo/interpreter/parameter_file.hpp"

#include <iterator>

#include "file_fields.hpp"
#include "parameters.hpp"
#include <fmt/format.h>

namespace passo {

bool is_always_saved(int number) {
  const auto axes_from = [number](int first) {
    return number >= first && number < first + static_cast<int>(axis_count);
  };
  if (axes_from(first_home_parameter) || axes_from(second_home_parameter) || axes_from(g92_parameter)) return true;
  if (number == g92_active_parameter || number == work_system_parameter) return true;
  for (int system = 1; system <= work_systems; ++system) {
    if (axes_from(work_offset_parameter(system)) || number == rotation_parameter(system)) return true;
  }
  return false;
}

bool read_parameter_file(const std::string& path, SavedParameters& parameters, Diagnostics& diagnostics) {
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(path);
  parameters.clear();
  if (!reader) {
    Diagnostic problem = reader.error();
    if (problem.code == "file.empty") return true;  // no parameters
    problem.expected = "a parameter file with one parameter per line: number, tab, value";
    diagnostics.add(std::move(problem));
    return false;
  }
  const std::size_t before = diagnostics.errors();
  FieldReader fields(std::move(*reader), diagnostics);
  while (fields.next_line()) {
    Field number;
    Field value;
    if (!fields.next_field(number) || number.text.starts_with('#') || number.text.starts_with(';')) continue;
    const std::optional<std::int32_t> index = whole_number_of(number.text);
    if (!index || *index < 1 || *index > highest_parameter) {
      fields.error("parameters.bad-number", number, fmt::format("{} is not a parameter number", quoted(number.text)),
                   fmt::format("a whole number, 1 to {}", highest_parameter));
      continue;
    }
    const std::optional<double> content = fields.next_field(value) ? number_of(value.text) : std::nullopt;
    if (!content) {
      const Field& place = value.text.empty() ? number : value;
      fields.error("parameters.bad-value", place, fmt::format("parameter {} has no value", *index),
                   "a value after the number, e.g. 5221\t12.5");
      continue;
    }
    if (*index == work_system_parameter && !(*content >= 1 && *content <= work_systems)) {
      fields.error("parameters.bad-value", value, fmt::format("there is no work offset {}", quoted(value.text)),
                   fmt::format("1 to {}", work_systems));
      continue;
    }
    if (!parameters.try_emplace(*index, *content).second) {
      fields.error("parameters.repeated", number, fmt::format("a second line for parameter {}", *index),
                   "each number once");
      continue;
    }
    if (const Field more = fields.rest(); !more.text.empty() && !more.text.starts_with('#')) {
      fields.error("parameters.bad-value", more, fmt::format("{} after the value", quoted(more.text)),
                   "one number and one value per line");
    }
  }
  return diagnostics.errors() == before;
}

std::string parameter_file_text(const SavedParameters& parameters) {
  std::string text;
  for (const auto& [number, value] : parameters) {
    fmt::format_to(std::back_inserter(text), "{}\t{:.6f}\n", number, value);
  }
  return text;
}

void replace_persistent_offsets(SavedParameters& into, const SavedParameters& from) {
  const auto lasts = [](int number) {
    const bool is_of_g92 = number >= g92_active_parameter && number < work_system_parameter;
    return is_always_saved(number) && !is_of_g92 && number != work_system_parameter;
  };
  std::erase_if(into, [&](const auto& one) { return lasts(one.first); });
  for (const auto& [number, value] : from) {
    if (lasts(number)) into[number] = value;
  }
}

}  // namespace passo
