#include "encoder_reader.hpp"

namespace passo {
namespace {

constexpr NumberKey turn_counts_key{"counts_per_turn", 4, 1e7, "4000"};
constexpr NumberKey error_mm_key{"most_following_error_mm", 1e-4, 1000, "0.5"};
constexpr NumberKey error_deg_key{"most_following_error_deg", 1e-4, 1000, "0.5"};
constexpr std::string_view encoder_table = "encoder";

}  // namespace

std::optional<EncoderDescription> read_encoder_of(TableReader& axis, bool rotary, const TomlReporter& reporter,
                                                  const std::function<void(TableReader&)>& finish) {
  const TomlEntry* table = axis.table(encoder_table, "a table [axis.X.encoder] with its counts", Need::optional);
  if (table == nullptr) return std::nullopt;
  TableReader reader(std::get<TomlTable>(table->value.content), axis.full_name(encoder_table), table->place, reporter);
  const auto counts = reader.whole_number(turn_counts_key, Need::required);
  EncoderDescription encoder;
  encoder.most_error = reader.number(rotary ? error_deg_key : error_mm_key, Need::optional).value_or(0);
  encoder.closes_loop = reader.flag("closed_loop").value_or(false);
  finish(reader);
  if (!counts) return std::nullopt;
  encoder.counts_per_turn = static_cast<int>(*counts);
  return encoder;
}

}  // namespace passo
