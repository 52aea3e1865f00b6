// All headers of libpasso: docs/library.md.
#pragma once

#include "passo/library/axes.hpp"
#include "passo/library/check.hpp"
#include "passo/library/finding.hpp"
#include "passo/library/gcode.hpp"
#include "passo/library/motion.hpp"
#include "passo/library/picture.hpp"
#include "passo/library/version.hpp"
