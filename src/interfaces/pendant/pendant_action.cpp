#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "passo/pendant/pendant_table.hpp"

namespace passo {
namespace {

using ActionKind = PendantAction::Kind;

enum class Operand : std::uint8_t { none, word, axis, perhaps_axis };

struct ActionRow {
  std::string_view name;
  ActionKind kind;
  Operand operand = Operand::none;
};

constexpr std::array rows{
    ActionRow{"none", ActionKind::none},
    ActionRow{"modifier", ActionKind::modifier},
    ActionRow{"start", ActionKind::start},
    ActionRow{"hold", ActionKind::hold},
    ActionRow{"stop", ActionKind::stop},
    ActionRow{"reset", ActionKind::reset},
    ActionRow{"home", ActionKind::home},
    ActionRow{"go", ActionKind::go, Operand::word},
    ActionRow{"macro", ActionKind::macro, Operand::word},
    ActionRow{"zero", ActionKind::zero, Operand::perhaps_axis},
    ActionRow{"axis", ActionKind::select_axis, Operand::axis},
    ActionRow{"step-mode", ActionKind::step_mode},
    ActionRow{"continuous-mode", ActionKind::continuous_mode},
    ActionRow{"other-mode", ActionKind::other_mode},
    ActionRow{"coarser", ActionKind::coarser},
    ActionRow{"finer", ActionKind::finer},
    ActionRow{"feed-up", ActionKind::feed_up},
    ActionRow{"feed-down", ActionKind::feed_down},
    ActionRow{"spindle-up", ActionKind::spindle_up},
    ActionRow{"spindle-down", ActionKind::spindle_down},
    ActionRow{"spindle-stop", ActionKind::spindle_stop},
};
constexpr std::size_t longest_word = 60;

}  // namespace

std::optional<PendantAction> parse_pendant_action(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const bool has_operand = colon != std::string_view::npos;
  const std::string_view word = has_operand ? text.substr(colon + 1) : std::string_view();
  const auto row = std::ranges::find(rows, name, &ActionRow::name);
  if (row == rows.end() || word.size() > longest_word || has_operand == word.empty()) return {};
  PendantAction action{.kind = row->kind};
  switch (row->operand) {
    case Operand::none: return has_operand ? std::nullopt : std::optional(action);
    case Operand::word: action.word = word; return has_operand ? std::optional(action) : std::nullopt;
    case Operand::axis:
    case Operand::perhaps_axis: break;
  }
  if (!has_operand) return row->operand == Operand::perhaps_axis ? std::optional(action) : std::nullopt;
  action.axis = word.size() == 1 ? axis_of(word.front()) : std::nullopt;
  return action.axis ? std::optional(action) : std::nullopt;
}

std::string pendant_actions_in_words() {
  std::string words;
  for (const ActionRow& row : rows) {
    words += words.empty() ? "" : ", ";
    words += row.name;
    if (row.operand == Operand::word) words += ":NAME";
    if (row.operand == Operand::axis || row.operand == Operand::perhaps_axis) words += ":X";
  }
  return words;
}

}  // namespace passo
