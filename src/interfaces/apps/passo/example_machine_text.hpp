// The machine file of `passo serve` without one: examples/machines/router.toml, as text in the program.
#pragma once

namespace passo {

extern const char* const example_machine_text;

}  // namespace passo
