// A WebSocket as a plain line of bytes, as FluidNC and grblHAL offer it over the network.
//
// The protocol is Boost.Beast's. A thread of its own moves the bytes between the WebSocket and one end of a pair of
// sockets; StreamPort has the other end, and need not know what is behind it.
#pragma once

#include <string>

#include "passo/base/result.hpp"

namespace passo {

// Makes a WebSocket of an open connection, which it takes over, and returns the descriptor of the bytes, non-blocking.
// Sent bytes become binary messages. A received text message without a line end gets one. When one side closes, the
// other one is closed too. The error is a sentence with the reason.
Result<int, std::string> open_websocket(int connection, const std::string& host);

}  // namespace passo
