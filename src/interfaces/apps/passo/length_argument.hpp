// Lengths on the command line. Job files have the same lengths, so their reader is in operations/.
#pragma once

#include "passo/operations/length_text.hpp"
