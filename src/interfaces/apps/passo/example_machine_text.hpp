// The default machine file of `passo serve`: examples/machines/router.toml, embedded in the program.
#pragma once

namespace passo {

extern const char* const example_machine_text;

}  // namespace passo
