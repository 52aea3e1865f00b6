// The tables of known pendants: the files of examples/pendants. Private to pendant/.
#pragma once

namespace passo {

extern const char* const known_pendant_texts[3];

}  // namespace passo
