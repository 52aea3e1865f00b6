// import_in_browser(): makes a machine file from the configuration of another controller, as `passo machine --from`
// does.
#pragma once

#include <string>

namespace passo {

// `request`: {"file", "text", "format", "tree"}. `format`: a name of ImportFormat; empty: by the text. `tree`: for the
// formats that JavaScript reads, YAML and XML: {"name", "text", "children", "line", "column"}. Returns {"good",
// "format", "findings"} and, if good, "controller", "toml", "understood", "assumed", "unmapped" and "warnings". With a
// format that needs a tree and without one, only "format".
std::string import_in_browser(const std::string& request);

}  // namespace passo
