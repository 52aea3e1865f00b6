// hershey_simplex: the text of a .jhf font. Private to cam/.
#pragma once

namespace passo {

extern const char* const hershey_simplex;

}  // namespace passo
