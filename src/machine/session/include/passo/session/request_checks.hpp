// What every kind of session checks in a request, whatever its board is. An empty result: nothing is wrong.
#pragma once

#include <optional>
#include <string>

#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_abilities.hpp"
#include "passo/session/machine_state.hpp"
#include "passo/session/machine_status.hpp"
#include "passo/session/refusal.hpp"
#include "passo/session/request.hpp"

namespace passo {

bool all_finite(const Point& point);
// Why nothing can begin in this state. `is_busy`: an activity is running or held.
Refusal refusal_in(MachineState state, bool is_busy);
std::optional<Refusal> refusal_of(const request::Jog& jog);
std::optional<Refusal> refusal_of(const request::RenewKeepAlive& renew);
// `slack`: how exactly the board reports its position.
std::optional<Refusal> refusal_of(const request::Probe& probe, const MachineDescription& machine,
                                  const KnownPosition& position, Mm slack);
std::optional<Refusal> refusal_of(const request::Override& change);
// What the board cannot do, in words of its own. `code`: of the sentence, for translations.
Refusal refused_because(std::string code, std::string why);
// The machine lacks this ability.
Refusal refusal_of(const MachineAbilities& abilities, Ability ability);
// The output that opens the collet of a tool rack is switched by the tool change alone.
std::optional<Refusal> refusal_of(const request::SwitchOutputs& wanted, const MachineDescription& machine);

}  // namespace passo
