// migrate(): brings the tables of a database to the version of this program. Private to farm_store/.
#pragma once

#include "passo/farm_store/farm_store.hpp"

namespace passo {

// Each migration is a transaction of its own with the row that records it. Programs that start at the same time may
// call it together. Fails if the tables are of a newer version.
FarmStore::Answer<Unit> migrate(Database& database);

}  // namespace passo
