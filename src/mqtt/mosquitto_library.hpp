// libmosquitto, loaded when --mqtt asks for it. With it comes OpenSSL: a sixth of the memory and a third of the time of
// a start, which no other command needs (decision 0120). Private to mqtt/.
#pragma once

#include <mosquitto.h>

namespace passo {

// The functions of the library that are used, with the types of its header.
struct MosquittoLibrary {
  decltype(&mosquitto_lib_init) lib_init = nullptr;
  decltype(&mosquitto_lib_cleanup) lib_cleanup = nullptr;
  decltype(&mosquitto_new) create = nullptr;
  decltype(&mosquitto_destroy) destroy = nullptr;
  decltype(&mosquitto_threaded_set) threaded_set = nullptr;
  decltype(&mosquitto_will_set) will_set = nullptr;
  decltype(&mosquitto_username_pw_set) username_pw_set = nullptr;
  decltype(&mosquitto_connect_callback_set) connect_callback_set = nullptr;
  decltype(&mosquitto_connect_async) connect_async = nullptr;
  decltype(&mosquitto_loop) loop = nullptr;
  decltype(&mosquitto_publish) publish = nullptr;
  decltype(&mosquitto_disconnect) disconnect = nullptr;
  decltype(&mosquitto_strerror) strerror = nullptr;
};

// Loaded by the first call, and kept. Null: this computer has no such library.
const MosquittoLibrary* mosquitto_library();

}  // namespace passo
