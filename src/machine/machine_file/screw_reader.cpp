#include "screw_reader.hpp"

#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

struct ScrewKeys {
  NumberKey backlash;
  NumberKey errors;
};
constexpr ScrewKeys linear_screw{
    .backlash = {"backlash_mm", 0, 10, "0.15"},
    .errors = {"error_mm", -1e5, 1e5, "[[-100, 0.0], [0, 0.012], [100, -0.004]]"},
};
constexpr ScrewKeys rotary_screw{
    .backlash = {"backlash_deg", 0, 10, "0.1"},
    .errors = {"error_deg", -1e7, 1e7, "[[-180, 0.0], [0, 0.02], [180, 0.0]]"},
};

const char* const screw_code = "machine.screw";
constexpr double steepest = 0.01;

void read_errors(TableReader& reader, const NumberKey& key, ScrewDescription& screw) {
  const auto pairs = reader.pairs(key);
  if (!pairs) return;
  for (std::size_t i = 1; i < pairs->size(); ++i) {
    const LowHigh& before = (*pairs)[i - 1];
    const LowHigh& here = (*pairs)[i];
    const double way = here.low - before.low;
    if (!(way > 0)) {
      return reader.error(screw_code, key.name,
                          fmt::format("{} has {:g} after {:g}", reader.full_name(key.name), here.low, before.low),
                          "positions in ascending order, each once");
    }
    if (!(std::abs(here.high - before.high) < steepest * way)) {
      return reader.error(screw_code, key.name,
                          fmt::format("the error of {} changes by {:g} between {:g} and {:g}",
                                      reader.full_name(key.name), here.high - before.high, before.low, here.low),
                          "pairs of a position and its error (true minus nominal position), where the error changes by "
                          "less than 1 % of the distance");
    }
  }
  for (const LowHigh& pair : *pairs) screw.errors.push_back({.at = pair.low, .off = pair.high});
}

constexpr std::string_view screw_table = "screw";

}  // namespace

std::optional<ScrewDescription> read_screw_of(TableReader& axis, bool rotary, const TomlReporter& reporter,
                                              const std::function<void(TableReader&)>& finish) {
  const TomlEntry* table = axis.table(screw_table, "a table [axis.X.screw] with its backlash", Need::optional);
  if (table == nullptr) return std::nullopt;
  TableReader reader(std::get<TomlTable>(table->value.content), axis.full_name(screw_table), table->place, reporter);
  const ScrewKeys& keys = rotary ? rotary_screw : linear_screw;
  ScrewDescription screw;
  screw.backlash = reader.number(keys.backlash, Need::optional).value_or(0);
  reader.know(keys.errors.name);
  if (reader.has(keys.errors.name)) read_errors(reader, keys.errors, screw);
  screw.is_compensated = reader.flag("compensate").value_or(true);
  finish(reader);
  return screw;
}

}  // namespace passo
